// Momentum: V' is a step from Y held in the box (check_step), the change is V' - V, and Y' = V' + m change rounded once
// and held in the box. m change is a product that the query knows as `product` (cut: of which it knows
// |m change| <= |change| alone, which check_product proves).
module check_momentum #(
    parameter STATE_BITS = 24,
    parameter STATE_FRACTION = 22,
    parameter STATE_MODE = 0,
    parameter DRIVE_FRACTION = 16,
    parameter BEHIND_PRODUCT = 0
) (
    input wire                         clock,
    input wire                         drive_negative,
    input wire        [DRIVE_FRACTION:0] drive_size,
    input wire signed [STATE_BITS-1:0] state,
    input wire signed [STATE_BITS-1:0] point,
    input wire signed [STATE_BITS+2:0] ahead  // what the solver likes, as long as it is m change rounded
);
  localparam LATENCY = 1 + BEHIND_PRODUCT;
  localparam PRODUCT_BITS = STATE_BITS + 17;
  localparam WIDE = PRODUCT_BITS + 3;
  localparam signed [WIDE-1:0] ONE = {{(WIDE - 1) {1'b0}}, 1'b1} <<< STATE_FRACTION;
  localparam signed [WIDE-1:0] PLACE = {{(WIDE - 1) {1'b0}}, 1'b1} <<< 15;
  // Stands still while a sweep goes.
  (* anyconst *) reg signed [15:0] momentum;
  wire signed [STATE_BITS:0] change;
  wire signed [STATE_BITS-1:0] new_state, new_point, stepped;
  hm_output_momentum #(
      .STATE_BITS(STATE_BITS),
      .STATE_FRACTION(STATE_FRACTION),
      .STATE_MODE(STATE_MODE),
      .DRIVE_FRACTION(DRIVE_FRACTION),
      .BEHIND_PRODUCT(BEHIND_PRODUCT)
  ) dut (
      .clock(clock),
      .drive_negative(drive_negative),
      .drive_size(drive_size),
      .state(state),
      .point(point),
      .momentum(momentum),
      .change(change),
      .new_state(new_state),
      .new_point(new_point)
  );
  hm_output_step #(
      .STATE_BITS(STATE_BITS),
      .STATE_FRACTION(STATE_FRACTION),
      .STATE_MODE(STATE_MODE),
      .DRIVE_FRACTION(DRIVE_FRACTION),
      .UNIT(DRIVE_FRACTION)
  ) step (
      .drive_negative(drive_negative),
      .drive_size(drive_size),
      .point(point),
      .new_state(stepped)
  );
  wire signed [STATE_BITS-1:0] kept_stepped, kept_state, right_state;
  hm_register #(
      .WIDTH(2 * STATE_BITS),
      .COUNT(BEHIND_PRODUCT)
  ) keep (
      .clock(clock),
      .now  ({stepped, state}),
      .later({kept_stepped, kept_state})
  );
  wire signed [STATE_BITS:0] moved = {kept_stepped[STATE_BITS-1], kept_stepped} - {kept_state[STATE_BITS-1], kept_state};
  wire signed [STATE_BITS:0] right_change;
  hm_register #(
      .WIDTH(2 * STATE_BITS + 1),
      .COUNT(1)
  ) keep_more (
      .clock(clock),
      .now  ({kept_stepped, moved}),
      .later({right_state, right_change})
  );
  wire signed [PRODUCT_BITS-1:0] product;
  generate
    if (BEHIND_PRODUCT != 0) begin : product_first
      wire signed [PRODUCT_BITS-1:0] m_change = momentum * moved;
      hm_register #(
          .WIDTH(PRODUCT_BITS),
          .COUNT(1)
      ) keep_product (
          .clock(clock),
          .now  (m_change),
          .later(product)
      );
    end else begin : product_last
      assign product = momentum * right_change;
    end
  endgenerate
  wire out;
  hm_register #(
      .WIDTH(1),
      .COUNT(LATENCY)
  ) keep_valid (
      .clock(clock),
      .now  (1'b1),
      .later(out)
  );
  wire signed [WIDE-1:0] wide_point = {{(WIDE - STATE_BITS) {point[STATE_BITS-1]}}, point};
  wire signed [WIDE-1:0] wide_state = {{(WIDE - STATE_BITS) {state[STATE_BITS-1]}}, state};
  wire signed [WIDE-1:0] x = {{3{product[PRODUCT_BITS-1]}}, product};
  wire signed [WIDE-1:0] wide_ahead = {{(WIDE - STATE_BITS - 3) {ahead[STATE_BITS+2]}}, ahead};
  wire signed [WIDE-1:0] after = {{(WIDE - STATE_BITS) {right_state[STATE_BITS-1]}}, right_state};
  wire signed [WIDE-1:0] after_point = {{(WIDE - STATE_BITS) {new_point[STATE_BITS-1]}}, new_point};
  wire signed [WIDE-1:0] to = after + wide_ahead;
  wire is_ahead;
  rounding #(
      .WIDE(WIDE),
      .MODE(STATE_MODE)
  ) rule (
      .negative(x < 0),
      .odd(ahead[0]),
      .off(x - (wide_ahead <<< 15)),
      .place(PLACE),
      .right(is_ahead)
  );
  always @* begin
    assume (drive_size <= {1'b1, {DRIVE_FRACTION{1'b0}}});
    assume (-ONE <= wide_state && wide_state <= ONE);
    assume (-ONE <= wide_point && wide_point <= ONE);
    if (out) begin
      assume (is_ahead);
      assert (new_state == right_state);
      assert (change == right_change);
      assert (-ONE <= after && after <= ONE);
      assert (-ONE <= after_point && after_point <= ONE);
      assert (after_point == ((to > ONE) ? ONE : (to < -ONE) ? -ONE : to));
    end
  end
endmodule
