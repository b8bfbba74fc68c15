// The input accumulator of an element, without the bias, which joins in the output stage. With `norms` it sums
// |w| times the code of 1.0, so that one adder serves s and N. `total` is what `sum` is about to hold.
module hm_accumulator #(
    parameter WEIGHT_BITS = 16,
    parameter LINK_BITS = 16,
    parameter LINK_FRACTION = 14,
    parameter SUM_BITS = 39,
    parameter PRODUCT_UP = 0  // places from a product's point to the sum's
) (
    input  wire                          clock,
    input  wire                          add,
    input  wire                          clear,   // after this cycle: the next row begins
    input  wire                          norms,
    input  wire signed [WEIGHT_BITS-1:0] weight,
    input  wire signed [  LINK_BITS-1:0] link,
    output wire signed [   SUM_BITS-1:0] total
);
  localparam PRODUCT_BITS = WEIGHT_BITS + LINK_BITS;
  localparam signed [LINK_BITS-1:0] ONE = {{(LINK_BITS - 1) {1'b0}}, 1'b1} <<< LINK_FRACTION;

  wire signed [LINK_BITS-1:0] sign = weight[WEIGHT_BITS-1] ? -ONE : ONE;
  wire signed [LINK_BITS-1:0] factor = !add ? {LINK_BITS{1'b0}} : norms ? sign : link;
  wire signed [PRODUCT_BITS-1:0] product = weight * factor;
  wire signed [SUM_BITS-1:0] addend;
  reg signed [SUM_BITS-1:0] sum = {SUM_BITS{1'b0}};

  hm_resize #(
      .FROM(PRODUCT_BITS),
      .TO(SUM_BITS)
  ) resize (
      .number(product),
      .resized(addend)
  );
  assign total = sum + (addend <<< PRODUCT_UP);

  always @(posedge clock) begin
    if (clear) sum <= {SUM_BITS{1'b0}};
    else if (add) sum <= total;
  end
endmodule
