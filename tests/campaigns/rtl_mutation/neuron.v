// An accumulator and an output stage with the formats of a folder of firings: what mutants are made of. `held` is what
// an element keeps of a sum.
module neuron (
    clock,
    add,
    clear,
    norms,
    weight_in,
    link_in,
    take,
    take_norm,
    bias_in,
    kept,
    m,
    state_in,
    point_in,
    norm_ready,
    norm_kept,
    judged,
    free,
    size,
    publish,
    sum_negative,
    sum_zero,
    change_out,
    new_state,
    new_point,
    state_link,
    point_link
);
  `include "neuron_layout.vh"
  localparam HAS_NORM = (OUTPUT != 1) && (NORMALISER != 0);
  localparam NORM_FRACTION = (WEIGHT_FRACTION > BIAS_FRACTION) ? WEIGHT_FRACTION : BIAS_FRACTION;
  localparam NORM_BITS = ACCUMULATOR_BITS - 1 - (ACCUMULATOR_FRACTION - NORM_FRACTION);
  localparam SHIFT_BITS = $clog2(NORM_BITS + 1);
  localparam KEPT_BITS = (NORMALISER == 1) ? SHIFT_BITS + RECIPROCAL_BITS : NORM_BITS;
  input wire clock, add, clear, norms, take, take_norm;
  input wire signed [WEIGHT_BITS-1:0] weight_in;
  input wire signed [LINK_BITS-1:0] link_in;
  input wire signed [BIAS_BITS-1:0] bias_in;
  input wire [KEPT_BITS-1:0] kept;
  input wire signed [15:0] m;
  input wire signed [STATE_BITS-1:0] state_in, point_in;
  output wire norm_ready, judged, free, publish, sum_negative, sum_zero;
  output wire [KEPT_BITS-1:0] norm_kept;
  output wire [ACCUMULATOR_BITS-2:0] size;
  output wire signed [STATE_BITS:0] change_out;
  output wire signed [STATE_BITS-1:0] new_state, new_point;
  output wire signed [LINK_BITS-1:0] state_link, point_link;

  wire signed [ACCUMULATOR_BITS-1:0] total;
  reg signed [ACCUMULATOR_BITS-1:0] held = 0;
  always @(posedge clock) if (clear) held <= total;
  hm_accumulator #(
      .WEIGHT_BITS(WEIGHT_BITS),
      .LINK_BITS(LINK_BITS),
      .LINK_FRACTION(LINK_FRACTION),
      .SUM_BITS(ACCUMULATOR_BITS),
      .PRODUCT_UP(ACCUMULATOR_FRACTION - WEIGHT_FRACTION - LINK_FRACTION)
  ) accumulator (
      .clock (clock),
      .add   (add),
      .clear (clear),
      .norms (norms),
      .weight(weight_in),
      .link  (link_in),
      .total (total)
  );
  hm_stage #(
      .OUTPUT(OUTPUT),
      .NORMALISER(NORMALISER),
      .PIPELINE(PIPELINE),
      .PIPELINED(0),
      .WEIGHT_FRACTION(WEIGHT_FRACTION),
      .BIAS_BITS(BIAS_BITS),
      .BIAS_FRACTION(BIAS_FRACTION),
      .SUM_BITS(ACCUMULATOR_BITS),
      .SUM_FRACTION(ACCUMULATOR_FRACTION),
      .DRIVE_BITS(DRIVE_BITS),
      .DRIVE_FRACTION(DRIVE_FRACTION),
      .DRIVE_MODE(DRIVE_ROUNDING),
      .DRIVE_OVERFLOW(DRIVE_OVERFLOW),
      .STATE_BITS(STATE_BITS),
      .STATE_FRACTION(STATE_FRACTION),
      .STATE_MODE(STATE_ROUNDING),
      .LINK_BITS(LINK_BITS),
      .LINK_FRACTION(LINK_FRACTION),
      .LINK_MODE(LINK_ROUNDING),
      .MANTISSA(RECIPROCAL_BITS),
      .RELAXATION(RELAXATION),
      .NORM_BITS(NORM_BITS),
      .SHIFT_BITS(SHIFT_BITS),
      .KEPT_BITS(KEPT_BITS)
  ) stage (
      .clock(clock),
      .take(take),
      .take_norm(take_norm),
      .held(held),
      .bias(bias_in),
      .kept(kept),
      .momentum(m),
      .state(state_in),
      .point(point_in),
      .norm_ready(norm_ready),
      .norm_kept(norm_kept),
      .judged(judged),
      .free(free),
      .size(size),
      .publish(publish),
      .sum_negative(sum_negative),
      .sum_zero(sum_zero),
      .change(change_out),
      .new_state(new_state),
      .new_point(new_point),
      .state_link(state_link),
      .point_link(point_link)
  );
endmodule
