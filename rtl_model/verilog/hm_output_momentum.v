// Momentum: V' a step from Y, the change V' - V, and Y' = V' + m change, held in the box. A cycle for V' and the
// change, one for Y'; with BEHIND_PRODUCT = 1 a cycle for V', one for the change and the product, one for Y'.
module hm_output_momentum #(
    parameter STATE_BITS = 24,
    parameter STATE_FRACTION = 22,
    parameter STATE_MODE = 0,
    parameter DRIVE_FRACTION = 16,
    parameter BEHIND_PRODUCT = 0
) (
    input  wire                         clock,
    input  wire                         drive_negative,
    input  wire        [DRIVE_FRACTION:0] drive_size,
    input  wire signed [STATE_BITS-1:0] state,      // V, in the cycle of the drive
    input  wire signed [STATE_BITS-1:0] point,      // Y, in the same cycle
    input  wire signed [          15:0] momentum,   // m: stands still while a sweep goes
    output wire signed [  STATE_BITS:0] change,     // in the last cycle, as both that follow
    output wire signed [STATE_BITS-1:0] new_state,
    output wire signed [STATE_BITS-1:0] new_point
);
  localparam MOMENTUM_DOWN = 15;
  localparam PRODUCT_BITS = STATE_BITS + 1 + 16;
  localparam AHEAD_BITS = STATE_BITS + 3;
  wire signed [STATE_BITS-1:0] stepped, kept_stepped, kept_state;
  wire signed [STATE_BITS:0] moved;
  wire signed [PRODUCT_BITS-1:0] product, kept_product;
  wire signed [AHEAD_BITS-1:0] ahead;

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
  hm_register #(
      .WIDTH(2 * STATE_BITS),
      .COUNT(BEHIND_PRODUCT)
  ) first (
      .clock(clock),
      .now  ({stepped, state}),
      .later({kept_stepped, kept_state})
  );
  assign moved = {kept_stepped[STATE_BITS-1], kept_stepped} - {kept_state[STATE_BITS-1], kept_state};
  hm_register #(
      .WIDTH(2 * STATE_BITS + 1),
      .COUNT(1)
  ) changed (
      .clock(clock),
      .now  ({kept_stepped, moved}),
      .later({new_state, change})
  );
  generate
    if (BEHIND_PRODUCT != 0) begin : product_first
      assign product = momentum * moved;
      hm_register #(
          .WIDTH(PRODUCT_BITS),
          .COUNT(1)
      ) multiplied (
          .clock(clock),
          .now  (product),
          .later(kept_product)
      );
    end else begin : product_last
      assign product = momentum * change;
      assign kept_product = product;
    end
  endgenerate
  hm_round_places #(
      .FROM(PRODUCT_BITS),
      .DOWN(MOMENTUM_DOWN),
      .TO(AHEAD_BITS),
      .MODE(STATE_MODE),
      .MAGNITUDE(0)
  ) round (
      .number(kept_product),
      .negative(1'b0),
      .rounded(ahead)
  );
  wire signed [AHEAD_BITS-1:0] wide_state = {{3{new_state[STATE_BITS-1]}}, new_state};
  hm_limit #(
      .FROM(AHEAD_BITS),
      .UNIT(STATE_FRACTION),
      .TO(STATE_BITS)
  ) limit (
      .code(wide_state + ahead),
      .limited(new_point)
  );
endmodule
