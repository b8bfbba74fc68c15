// A step of u from a point: u moved to the state's fraction, rounded once, added, held in the box.
module check_step #(
    parameter STATE_BITS = 24,
    parameter STATE_FRACTION = 22,
    parameter STATE_MODE = 0,
    parameter DRIVE_FRACTION = 16,
    parameter UNIT = 17
) (
    input wire                         drive_negative,
    input wire        [        UNIT:0] drive_size,
    input wire signed [STATE_BITS-1:0] point,
    input wire signed [STATE_BITS+UNIT:0] step  // what the solver likes, as long as it is u rounded
);
  localparam WIDE = STATE_BITS + UNIT + 4;
  localparam DOWN = (DRIVE_FRACTION > STATE_FRACTION) ? DRIVE_FRACTION - STATE_FRACTION : 0;
  localparam UP = (STATE_FRACTION > DRIVE_FRACTION) ? STATE_FRACTION - DRIVE_FRACTION : 0;
  wire signed [STATE_BITS-1:0] new_state;
  hm_output_step #(
      .STATE_BITS(STATE_BITS),
      .STATE_FRACTION(STATE_FRACTION),
      .STATE_MODE(STATE_MODE),
      .DRIVE_FRACTION(DRIVE_FRACTION),
      .UNIT(UNIT)
  ) dut (
      .drive_negative(drive_negative),
      .drive_size(drive_size),
      .point(point),
      .new_state(new_state)
  );
  localparam signed [WIDE-1:0] ONE = {{(WIDE - 1) {1'b0}}, 1'b1} <<< STATE_FRACTION;
  localparam signed [WIDE-1:0] PLACE = {{(WIDE - 1) {1'b0}}, 1'b1} <<< DOWN;
  wire signed [WIDE-1:0] size = {{(WIDE - UNIT - 1) {1'b0}}, drive_size};
  wire signed [WIDE-1:0] moved = (drive_negative ? -size : size) <<< UP;
  wire signed [WIDE-1:0] wide_step = {{3{step[STATE_BITS+UNIT]}}, step};
  wire signed [WIDE-1:0] from = {{(WIDE - STATE_BITS) {point[STATE_BITS-1]}}, point};
  wire signed [WIDE-1:0] after = {{(WIDE - STATE_BITS) {new_state[STATE_BITS-1]}}, new_state};
  wire signed [WIDE-1:0] to = from + wide_step;
  wire is_u;
  rounding #(
      .WIDE(WIDE),
      .MODE(STATE_MODE)
  ) rule (
      .negative(moved < 0),
      .odd(step[0]),
      .off(moved - (wide_step <<< DOWN)),
      .place(PLACE),
      .right(is_u)
  );
  always @* begin
    assume (drive_size <= {1'b1, {UNIT{1'b0}}});
    assume (-ONE <= from && from <= ONE);
    assume (is_u);
    assert (-ONE <= after && after <= ONE);
    assert (after == ((to > ONE) ? ONE : (to < -ONE) ? -ONE : to));
  end
endmodule
