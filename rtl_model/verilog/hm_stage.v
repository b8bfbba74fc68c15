// An output stage: a neuron goes in as what its element held, and comes out as its new V so many cycles later as
// docs/hardware/cycles.md tells. Has no memory: what a neuron keeps stands at the inputs in the cycle in which it goes
// in. In prepare, norms go in and come out on their way to the memory of the stage.
// OUTPUT: 0 modified, 1 binary, 2 projected, 3 momentum. NORMALISER: 0 prescaled, 1 reciprocal, 2 divider.
module hm_stage #(
    parameter OUTPUT = 0,
    parameter NORMALISER = 1,
    parameter PIPELINE = 0,
    parameter PIPELINED = 1,        // takes a neuron every cycle
    parameter WEIGHT_FRACTION = 15,
    parameter BIAS_BITS = 24,
    parameter BIAS_FRACTION = 15,
    parameter SUM_BITS = 39,
    parameter SUM_FRACTION = 29,
    parameter DRIVE_BITS = 18,
    parameter DRIVE_FRACTION = 16,
    parameter DRIVE_MODE = 0,
    parameter DRIVE_OVERFLOW = 0,
    parameter STATE_BITS = 24,
    parameter STATE_FRACTION = 22,
    parameter STATE_MODE = 0,
    parameter LINK_BITS = 16,
    parameter LINK_FRACTION = 14,
    parameter LINK_MODE = 0,
    parameter MANTISSA = 18,
    parameter RELAXATION = 29,
    parameter NORM_BITS = 24,       // of N
    parameter SHIFT_BITS = 5,
    parameter KEPT_BITS = 23        // of what is kept of N: {shift, mantissa}, or N
) (
    input  wire                         clock,
    input  wire                         take,
    input  wire                         take_norm,
    input  wire signed [  SUM_BITS-1:0] held,
    input  wire signed [ BIAS_BITS-1:0] bias,
    // verilator lint_off UNUSED
    input  wire        [ KEPT_BITS-1:0] kept,
    input  wire signed [          15:0] momentum,
    // verilator lint_on UNUSED
    input  wire signed [STATE_BITS-1:0] state,
    input  wire signed [STATE_BITS-1:0] point,       // Y, or V: what the link shows
    output wire                         norm_ready,
    output wire        [ KEPT_BITS-1:0] norm_kept,
    // In the cycle behind `take`: |s|, and whether s may move the neuron.
    output wire                         judged,
    output wire                         free,
    output wire        [  SUM_BITS-2:0] size,
    // In the last cycle.
    output wire                         publish,
    output wire                         sum_negative,
    output wire                         sum_zero,
    output wire signed [  STATE_BITS:0] change,
    output wire signed [STATE_BITS-1:0] new_state,
    output wire signed [STATE_BITS-1:0] new_point,
    output wire signed [ LINK_BITS-1:0] state_link,
    output wire signed [ LINK_BITS-1:0] point_link
);
  localparam MODIFIED = 0, BINARY = 1, PROJECTED = 2, MOMENTUM = 3;
  localparam PRESCALED = 0, RECIPROCAL = 1;
  localparam NORM_FRACTION = (WEIGHT_FRACTION > BIAS_FRACTION) ? WEIGHT_FRACTION : BIAS_FRACTION;
  localparam UNIT = DRIVE_FRACTION + ((OUTPUT == PROJECTED) ? 1 : 0);
  localparam FACTOR = (OUTPUT == PROJECTED) ? RELAXATION : 1;
  localparam FACTOR_DOWN = (OUTPUT == PROJECTED) ? 4 : 0;
  localparam HAS_NORM = (OUTPUT != BINARY) && (NORMALISER != PRESCALED);
  // Registers beyond the least, in the order in which they find their places.
  localparam FRONT = (HAS_NORM && PIPELINE >= 1) ? 1 : 0;
  localparam IN_ROUNDING = !HAS_NORM ? ((OUTPUT == MODIFIED && PIPELINE >= 2) ? 1 : 0) :
                           (PIPELINE >= ((OUTPUT == PROJECTED) ? 2 : 3)) ? 1 : 0;
  localparam BEHIND_PRODUCT = (OUTPUT == MODIFIED || OUTPUT == MOMENTUM) ?
                              ((PIPELINE >= (HAS_NORM ? 2 : 1)) ? 1 : 0) : 0;
  localparam BEHIND_PULL = (OUTPUT == MODIFIED && PIPELINE >= (HAS_NORM ? 4 : 3)) ? 1 : 0;
  localparam NORMALISE = !HAS_NORM ? 1 : (NORMALISER == RECIPROCAL) ? 2 : UNIT + 2;
  localparam DRIVE_CYCLES = NORMALISE + FRONT + IN_ROUNDING;
  localparam STAGE_CYCLES = DRIVE_CYCLES + ((OUTPUT == MODIFIED || OUTPUT == MOMENTUM) ? 2 : 1) + BEHIND_PRODUCT +
                            BEHIND_PULL;
  localparam OUTPUT_CYCLES = STAGE_CYCLES - DRIVE_CYCLES;
  localparam SIZE_BITS = SUM_BITS - 1;

  // ---- the sum, whole
  localparam BIAS_UP = SUM_FRACTION - BIAS_FRACTION;
  wire signed [SUM_BITS-1:0] wide_bias;
  hm_resize #(
      .FROM(BIAS_BITS),
      .TO(SUM_BITS)
  ) resize_bias (
      .number (bias),
      .resized(wide_bias)
  );
  wire signed [SUM_BITS-1:0] sum = held + (wide_bias <<< BIAS_UP);
  wire negative = sum[SUM_BITS-1];
  wire zero = ~|sum;
  // verilator lint_off UNUSED
  wire [SUM_BITS-1:0] whole_size = negative ? -sum : sum;
  // verilator lint_on UNUSED
  wire [SIZE_BITS-1:0] sum_size = whole_size[SIZE_BITS-1:0];

  // ---- what divides it
  generate
    if (HAS_NORM) begin : norm
      localparam WEIGHTS_DOWN = SUM_FRACTION - WEIGHT_FRACTION;  // `held` has |w| with the links' places behind it
      localparam WEIGHTS_UP = NORM_FRACTION - WEIGHT_FRACTION;
      localparam MAGNITUDE_UP = NORM_FRACTION - BIAS_FRACTION;
      localparam SUM_OR_NORM = ((SUM_BITS > NORM_BITS) ? SUM_BITS : NORM_BITS) + WEIGHTS_UP;
      // verilator lint_off UNUSED
      wire [SUM_OR_NORM-1:0] weights = {{(SUM_OR_NORM - SUM_BITS) {1'b0}}, held} >> WEIGHTS_DOWN << WEIGHTS_UP;
      wire [BIAS_BITS-1:0] bias_size = bias[BIAS_BITS-1] ? -bias : bias;
      wire [BIAS_BITS+NORM_BITS-1:0] wide_size = {{NORM_BITS{1'b0}}, bias_size} << MAGNITUDE_UP;
      // verilator lint_on UNUSED
      wire [NORM_BITS-1:0] bias_part = (OUTPUT == MODIFIED) ? wide_size[NORM_BITS-1:0] : {NORM_BITS{1'b0}};
      wire [NORM_BITS-1:0] divides = weights[NORM_BITS-1:0] + bias_part;
      if (NORMALISER == RECIPROCAL) begin : reciprocal
        wire [MANTISSA-1:0] mantissa;
        wire [SHIFT_BITS-1:0] shift;
        hm_reciprocal #(
            .NORM_BITS(NORM_BITS),
            .MANTISSA(MANTISSA),
            .SHIFT_BITS(SHIFT_BITS),
            .PIPELINED(PIPELINED)
        ) reciprocal (
            .clock(clock),
            .take(take_norm),
            .norm(divides),
            .ready(norm_ready),
            .mantissa(mantissa),
            .shift(shift)
        );
        assign norm_kept = {shift, mantissa};
      end else begin : divider
        assign norm_ready = take_norm;
        assign norm_kept = divides;
      end
    end else begin : no_norm
      assign norm_ready = 1'b0;
      assign norm_kept = {KEPT_BITS{1'b0}};
      // verilator lint_off UNUSED
      wire unused = take_norm;
      // verilator lint_on UNUSED
    end
  endgenerate

  // ---- u
  // Not every output asks for all of these.
  // verilator lint_off UNUSED
  wire drive_negative, ratio_negative;
  wire [UNIT:0] drive_size, ratio_size;
  wire drive_sum_negative, drive_sum_zero, drive_no_norm;
  wire signed [STATE_BITS-1:0] drive_state, drive_point;
  // verilator lint_on UNUSED
  generate
    if (OUTPUT == BINARY) begin : sign
      assign ratio_negative = 1'b0;
      assign ratio_size = {(UNIT + 1) {1'b0}};
    end else if (NORMALISER == PRESCALED) begin : prescaled
      hm_scale_prescaled #(
          .SUM_BITS(SUM_BITS),
          .DOWN(SUM_FRACTION - DRIVE_FRACTION),
          .DRIVE_BITS(DRIVE_BITS),
          .DRIVE_FRACTION(DRIVE_FRACTION),
          .DRIVE_MODE(DRIVE_MODE),
          .DRIVE_OVERFLOW(DRIVE_OVERFLOW),
          .BEHIND_ROUNDING(IN_ROUNDING)
      ) scale (
          .clock(clock),
          .negative(negative),
          .size(sum_size),
          .drive_negative(ratio_negative),
          .drive_size(ratio_size)
      );
    end else if (NORMALISER == RECIPROCAL) begin : reciprocal
      hm_scale_reciprocal #(
          .SUM_BITS(SUM_BITS),
          .MANTISSA(MANTISSA),
          .SHIFT_BITS(SHIFT_BITS),
          .MOST_SHIFT(NORM_BITS - 1),
          .DRIVE_FRACTION(DRIVE_FRACTION),
          .DRIVE_MODE(DRIVE_MODE),
          .UNIT(UNIT),
          .BOUNDED((OUTPUT == MODIFIED) ? 1 : 0),
          .FACTOR(FACTOR),
          .FACTOR_BITS(5),
          .FACTOR_DOWN(FACTOR_DOWN),
          .FRONT(FRONT),
          .BEHIND_SHIFT(IN_ROUNDING)
      ) scale (
          .clock(clock),
          .negative(negative),
          .size(sum_size),
          .mantissa(kept[MANTISSA-1:0]),
          .shift(kept[KEPT_BITS-1:MANTISSA]),
          .drive_negative(ratio_negative),
          .drive_size(ratio_size)
      );
    end else begin : divider
      hm_divide #(
          .SUM_BITS(SUM_BITS),
          .NORM_BITS(NORM_BITS),
          .NORM_UP(SUM_FRACTION - NORM_FRACTION),
          .UNIT(UNIT),
          .DRIVE_FRACTION(DRIVE_FRACTION),
          .DRIVE_MODE(DRIVE_MODE),
          .FACTOR(FACTOR),
          .FACTOR_BITS(5),
          .FACTOR_DOWN(FACTOR_DOWN),
          .FRONT(FRONT),
          .BEHIND_REST(IN_ROUNDING),
          .PIPELINED(PIPELINED)
      ) divide (
          .clock(clock),
          .take(take),
          .negative(negative),
          .size(sum_size),
          .norm(kept),
          .drive_negative(ratio_negative),
          .drive_size(ratio_size)
      );
    end
  endgenerate

  // ---- beside it: who is on the way, and with which V
  wire signed [LINK_BITS-1:0] shown;
  localparam signed [LINK_BITS-1:0] ONE_LINK = {{(LINK_BITS - 1) {1'b0}}, 1'b1} <<< LINK_FRACTION;
  reg [STAGE_CYCLES-2:0] on_way = {(STAGE_CYCLES - 1) {1'b0}};
  generate
    if (STAGE_CYCLES == 2) begin : short
      always @(posedge clock) on_way <= take;
    end else begin : long
      always @(posedge clock) on_way <= {on_way[STAGE_CYCLES-3:0], take};
    end
  endgenerate
  assign judged  = on_way[0];
  assign publish = on_way[STAGE_CYCLES-2];
  hm_register #(
      .WIDTH(3 + 2 * STATE_BITS),
      .COUNT(DRIVE_CYCLES)
  ) beside (
      .clock(clock),
      .now  ({negative, zero, ~|kept, state, point}),
      .later({drive_sum_negative, drive_sum_zero, drive_no_norm, drive_state, drive_point})
  );
  hm_register #(
      .WIDTH(2),
      .COUNT(OUTPUT_CYCLES - 1)
  ) beside_output (
      .clock(clock),
      .now  ({drive_sum_negative, drive_sum_zero}),
      .later({sum_negative, sum_zero})
  );
  hm_round_places #(
      .FROM(STATE_BITS),
      .DOWN(STATE_FRACTION - LINK_FRACTION),
      .TO(LINK_BITS),
      .MODE(LINK_MODE),
      .MAGNITUDE(0)
  ) round_shown (
      .number(point),
      .negative(1'b0),
      .rounded(shown)
  );
  wire held_by_bound = ((shown == ONE_LINK) & ~negative) | ((shown == -ONE_LINK) & (negative | zero));
  hm_register #(
      .WIDTH(1 + SIZE_BITS),
      .COUNT(1)
  ) judge (
      .clock(clock),
      .now  ({~held_by_bound, sum_size}),
      .later({free, size})
  );

  // ---- the output
  generate
    if (OUTPUT == MODIFIED) begin : modified
      assign drive_negative = ratio_negative;
      assign drive_size = ratio_size;
      hm_output_modified #(
          .STATE_BITS(STATE_BITS),
          .STATE_FRACTION(STATE_FRACTION),
          .STATE_MODE(STATE_MODE),
          .DRIVE_FRACTION(DRIVE_FRACTION),
          .BEHIND_PULL(BEHIND_PULL),
          .BEHIND_PRODUCT(BEHIND_PRODUCT)
      ) out (
          .clock(clock),
          .drive_negative(drive_negative),
          .drive_size(drive_size),
          .state(drive_state),
          .change(change),
          .new_state(new_state)
      );
      assign new_point = new_state;
    end else if (OUTPUT == BINARY) begin : binary
      assign drive_negative = ratio_negative;
      assign drive_size = ratio_size;
      hm_output_binary #(
          .STATE_BITS(STATE_BITS),
          .STATE_FRACTION(STATE_FRACTION)
      ) out (
          .negative(drive_sum_negative),
          .zero(drive_sum_zero),
          .state(drive_state),
          .change(change),
          .new_state(new_state)
      );
      assign new_point = new_state;
    end else begin : stepping
      // Where nothing divides s, its sign leads to the bound.
      assign drive_negative = drive_no_norm ? drive_sum_negative : ratio_negative;
      assign drive_size = !drive_no_norm ? ratio_size : drive_sum_zero ? {(UNIT + 1) {1'b0}} : {1'b1, {UNIT{1'b0}}};
      if (OUTPUT == PROJECTED) begin : projected
        hm_output_step #(
            .STATE_BITS(STATE_BITS),
            .STATE_FRACTION(STATE_FRACTION),
            .STATE_MODE(STATE_MODE),
            .DRIVE_FRACTION(DRIVE_FRACTION),
            .UNIT(UNIT)
        ) out (
            .drive_negative(drive_negative),
            .drive_size(drive_size),
            .point(drive_point),
            .new_state(new_state)
        );
        assign change = {new_state[STATE_BITS-1], new_state} - {drive_state[STATE_BITS-1], drive_state};
        assign new_point = new_state;
      end else begin : with_momentum
        hm_output_momentum #(
            .STATE_BITS(STATE_BITS),
            .STATE_FRACTION(STATE_FRACTION),
            .STATE_MODE(STATE_MODE),
            .DRIVE_FRACTION(DRIVE_FRACTION),
            .BEHIND_PRODUCT(BEHIND_PRODUCT)
        ) out (
            .clock(clock),
            .drive_negative(drive_negative),
            .drive_size(drive_size),
            .state(drive_state),
            .point(drive_point),
            .momentum(momentum),
            .change(change),
            .new_state(new_state),
            .new_point(new_point)
        );
      end
    end
  endgenerate

  // ---- what neighbours will see
  hm_round_places #(
      .FROM(STATE_BITS),
      .DOWN(STATE_FRACTION - LINK_FRACTION),
      .TO(LINK_BITS),
      .MODE(LINK_MODE),
      .MAGNITUDE(0)
  ) round_state (
      .number(new_state),
      .negative(1'b0),
      .rounded(state_link)
  );
  generate
    if (OUTPUT == MOMENTUM) begin : ahead
      hm_round_places #(
          .FROM(STATE_BITS),
          .DOWN(STATE_FRACTION - LINK_FRACTION),
          .TO(LINK_BITS),
          .MODE(LINK_MODE),
          .MAGNITUDE(0)
      ) round_point (
          .number(new_point),
          .negative(1'b0),
          .rounded(point_link)
      );
    end else begin : not_ahead
      assign point_link = state_link;
    end
  endgenerate
endmodule
