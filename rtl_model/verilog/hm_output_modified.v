// The paper's output stage: R = 1 - V or 1 + V, the change R u rounded, and V with it. A cycle each for the change and
// for V, and one more for each register behind R and behind the product.
module hm_output_modified #(
    parameter STATE_BITS = 24,
    parameter STATE_FRACTION = 22,
    parameter STATE_MODE = 0,
    parameter DRIVE_FRACTION = 16,
    parameter BEHIND_PULL = 0,
    parameter BEHIND_PRODUCT = 0
) (
    input  wire                         clock,
    input  wire                         drive_negative,
    input  wire        [DRIVE_FRACTION:0] drive_size,
    input  wire signed [STATE_BITS-1:0] state,       // in the cycle of the drive
    output wire signed [  STATE_BITS:0] change,      // in the last cycle, as the new state
    output wire signed [STATE_BITS-1:0] new_state
);
  localparam PULL_BITS = STATE_FRACTION + 2;  // of 0 to 2
  localparam PRODUCT_BITS = PULL_BITS + DRIVE_FRACTION + 1;
  localparam signed [STATE_BITS:0] ONE = {{STATE_BITS{1'b0}}, 1'b1} <<< STATE_FRACTION;

  wire signed [STATE_BITS:0] wide_state = {state[STATE_BITS-1], state};
  // verilator lint_off UNUSED
  wire [STATE_BITS:0] pull = drive_negative ? ONE + wide_state : ONE - wide_state;
  // verilator lint_on UNUSED
  wire pull_negative, product_negative;
  wire [DRIVE_FRACTION:0] pull_size;
  wire [PULL_BITS-1:0] kept_pull;
  wire [PRODUCT_BITS-1:0] product, kept_product;
  wire [PULL_BITS-1:0] size;
  wire signed [STATE_BITS:0] step;
  wire signed [STATE_BITS-1:0] change_state;

  hm_register #(
      .WIDTH(1 + DRIVE_FRACTION + 1 + PULL_BITS),
      .COUNT(BEHIND_PULL)
  ) pulled (
      .clock(clock),
      .now  ({drive_negative, drive_size, pull[PULL_BITS-1:0]}),
      .later({pull_negative, pull_size, kept_pull})
  );
  assign product = {{PULL_BITS{1'b0}}, pull_size} * {{(DRIVE_FRACTION + 1) {1'b0}}, kept_pull};
  hm_register #(
      .WIDTH(1 + PRODUCT_BITS),
      .COUNT(BEHIND_PRODUCT)
  ) multiplied (
      .clock(clock),
      .now  ({pull_negative, product}),
      .later({product_negative, kept_product})
  );
  hm_round_places #(
      .FROM(PRODUCT_BITS),
      .DOWN(DRIVE_FRACTION),
      .TO(PULL_BITS),
      .MODE(STATE_MODE),
      .MAGNITUDE(1)
  ) round (
      .number(kept_product),
      .negative(product_negative),
      .rounded(size)
  );
  wire [STATE_BITS:0] wide_size = {{(STATE_BITS + 1 - PULL_BITS) {1'b0}}, size};
  assign step = product_negative ? -wide_size : wide_size;
  hm_register #(
      .WIDTH(STATE_BITS + 1),
      .COUNT(1)
  ) changed (
      .clock(clock),
      .now  (step),
      .later(change)
  );
  hm_register #(
      .WIDTH(STATE_BITS),
      .COUNT(1 + BEHIND_PULL + BEHIND_PRODUCT)
  ) waited (
      .clock(clock),
      .now  (state),
      .later(change_state)
  );
  // verilator lint_off UNUSED
  wire signed [STATE_BITS:0] sum = {change_state[STATE_BITS-1], change_state} + change;
  // verilator lint_on UNUSED
  assign new_state = sum[STATE_BITS-1:0];
endmodule
