// The accumulator: a row's terms w L, or |w| times the code of 1.0 where norms are summed, added one a cycle, and 0
// before the next row. `dut` is hm_accumulator with its register as a port.
module check_accumulator #(
    parameter WEIGHT_BITS = 16,
    parameter LINK_BITS = 16,
    parameter LINK_FRACTION = 14,
    parameter SUM_BITS = 39,
    parameter PRODUCT_UP = 0
) (
    input wire                          clock,
    input wire                          add,
    input wire                          clear,
    input wire                          norms,
    input wire signed [WEIGHT_BITS-1:0] weight,
    input wire signed [  LINK_BITS-1:0] link
);
  wire signed [SUM_BITS-1:0] total;
  wire signed [SUM_BITS-1:0] kept;
  dut dut (
      .clock (clock),
      .add   (add),
      .clear (clear),
      .norms (norms),
      .weight(weight),
      .link  (link),
      .total (total),
      .sum   (kept)
  );
  wire signed [SUM_BITS-1:0] w = {{(SUM_BITS - WEIGHT_BITS) {weight[WEIGHT_BITS-1]}}, weight};
  wire signed [SUM_BITS-1:0] size = (w < 0) ? -w : w;
  wire signed [SUM_BITS-1:0] l = {{(SUM_BITS - LINK_BITS) {link[LINK_BITS-1]}}, link};
  reg signed [SUM_BITS-1:0] sum = 0;
  wire signed [SUM_BITS-1:0] term = (norms ? size <<< LINK_FRACTION : w * l) <<< PRODUCT_UP;
  wire signed [SUM_BITS-1:0] next = add ? sum + term : sum;
  always @(posedge clock) sum <= clear ? 0 : next;
  always @* begin
    assert (kept == sum);
    assert (total == next);
  end
endmodule
