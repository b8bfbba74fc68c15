// A step of u from `point`, held in the box: V' = min(max(point + step, -1), 1), and its way from V. The step is u
// moved to the state's fraction and rounded once.
module hm_output_step #(
    parameter STATE_BITS = 24,
    parameter STATE_FRACTION = 22,
    parameter STATE_MODE = 0,
    parameter DRIVE_FRACTION = 16,
    parameter UNIT = 17            // |u| is at most 2^UNIT of the drive's last places
) (
    input  wire                         drive_negative,
    input  wire        [        UNIT:0] drive_size,
    input  wire signed [STATE_BITS-1:0] point,
    output wire signed [STATE_BITS-1:0] new_state
);
  localparam DOWN = DRIVE_FRACTION - STATE_FRACTION;
  localparam STEP_BITS = UNIT + 2 - ((DOWN < UNIT) ? DOWN : UNIT);
  localparam WIDE = ((STEP_BITS > STATE_BITS) ? STEP_BITS : STATE_BITS) + 2;
  wire [STEP_BITS-1:0] size;
  hm_round_places #(
      .FROM(UNIT + 1),
      .DOWN(DOWN),
      .TO(STEP_BITS),
      .MODE(STATE_MODE),
      .MAGNITUDE(1)
  ) round (
      .number(drive_size),
      .negative(drive_negative),
      .rounded(size)
  );
  wire signed [WIDE-1:0] from = {{(WIDE - STATE_BITS) {point[STATE_BITS-1]}}, point};
  wire signed [WIDE-1:0] wide_size = {{(WIDE - STEP_BITS) {1'b0}}, size};
  wire signed [WIDE-1:0] to = drive_negative ? from - wide_size : from + wide_size;
  hm_limit #(
      .FROM(WIDE),
      .UNIT(STATE_FRACTION),
      .TO(STATE_BITS)
  ) limit (
      .code(to),
      .limited(new_state)
  );
endmodule
