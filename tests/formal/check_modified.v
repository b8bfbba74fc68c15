// The paper's output stage: the change is R u rounded once by its rule, never leads out of the box or away from where
// u points, and V moves by it. R u itself is a product that the query knows as `product` (cut: of which it knows
// 0 <= R u <= R alone, which check_product proves).
module check_modified #(
    parameter STATE_BITS = 24,
    parameter STATE_FRACTION = 22,
    parameter STATE_MODE = 0,
    parameter DRIVE_FRACTION = 16,
    parameter BEHIND_PULL = 0,
    parameter BEHIND_PRODUCT = 0
) (
    input wire                         clock,
    input wire                         drive_negative,
    input wire        [DRIVE_FRACTION:0] drive_size,
    input wire signed [STATE_BITS-1:0] state
);
  localparam PULL_BITS = STATE_FRACTION + 2;
  localparam PRODUCT_BITS = PULL_BITS + DRIVE_FRACTION + 1;
  localparam LATENCY = 1 + BEHIND_PULL + BEHIND_PRODUCT;
  localparam WIDE = PRODUCT_BITS + 3;
  localparam signed [STATE_BITS:0] ONE = {{STATE_BITS{1'b0}}, 1'b1} <<< STATE_FRACTION;
  localparam signed [WIDE-1:0] PLACE = {{(WIDE - 1) {1'b0}}, 1'b1} <<< DRIVE_FRACTION;
  wire signed [STATE_BITS:0] change;
  wire signed [STATE_BITS-1:0] new_state;
  hm_output_modified #(
      .STATE_BITS(STATE_BITS),
      .STATE_FRACTION(STATE_FRACTION),
      .STATE_MODE(STATE_MODE),
      .DRIVE_FRACTION(DRIVE_FRACTION),
      .BEHIND_PULL(BEHIND_PULL),
      .BEHIND_PRODUCT(BEHIND_PRODUCT)
  ) dut (
      .clock(clock),
      .drive_negative(drive_negative),
      .drive_size(drive_size),
      .state(state),
      .change(change),
      .new_state(new_state)
  );

  // R and R u of the neuron that comes out, told by the page's words and kept until then.
  wire signed [STATE_BITS:0] now = {state[STATE_BITS-1], state};
  wire signed [STATE_BITS:0] pull = drive_negative ? ONE + now : ONE - now;
  wire kept_negative, negative;
  wire [DRIVE_FRACTION:0] kept_size;
  wire [PULL_BITS-1:0] kept_pull;
  wire [PRODUCT_BITS-1:0] product;
  wire signed [STATE_BITS-1:0] before_state;
  hm_register #(
      .WIDTH(1 + DRIVE_FRACTION + 1 + PULL_BITS),
      .COUNT(BEHIND_PULL)
  ) keep (
      .clock(clock),
      .now  ({drive_negative, drive_size, pull[PULL_BITS-1:0]}),
      .later({kept_negative, kept_size, kept_pull})
  );
  wire [PRODUCT_BITS-1:0] r_u = {{PULL_BITS{1'b0}}, kept_size} * {{(DRIVE_FRACTION + 1) {1'b0}}, kept_pull};
  hm_register #(
      .WIDTH(1 + PRODUCT_BITS),
      .COUNT(1 + BEHIND_PRODUCT)
  ) keep_product (
      .clock(clock),
      .now  ({kept_negative, r_u}),
      .later({negative, product})
  );
  hm_register #(
      .WIDTH(STATE_BITS),
      .COUNT(LATENCY)
  ) keep_state (
      .clock(clock),
      .now  (state),
      .later(before_state)
  );
  wire out;
  hm_register #(
      .WIDTH(1),
      .COUNT(LATENCY)
  ) keep_valid (
      .clock(clock),
      .now  (1'b1),
      .later(out)
  );

  wire signed [STATE_BITS:0] before = {before_state[STATE_BITS-1], before_state};
  wire signed [STATE_BITS:0] after = {new_state[STATE_BITS-1], new_state};
  wire signed [WIDE-1:0] size = {3'b000, product};
  wire signed [WIDE-1:0] x = negative ? -size : size;
  wire signed [WIDE-1:0] q = {{(WIDE - STATE_BITS - 1) {change[STATE_BITS]}}, change};
  wire right;
  rounding #(
      .WIDE(WIDE),
      .MODE(STATE_MODE)
  ) rule (
      .negative(x < 0),
      .odd(change[0]),
      .off(x - (q <<< DRIVE_FRACTION)),
      .place(PLACE),
      .right(right)
  );
  always @* begin
    assume (drive_size <= {1'b1, {DRIVE_FRACTION{1'b0}}});
    assume (-ONE <= now && now <= ONE);
    if (out) begin
      assert (right);
      assert (after - before == change);
      assert (negative ? change <= 0 : change >= 0);
      assert (-ONE <= after && after <= ONE);
    end
  end
endmodule
