// Plays a folder of firings to the neuron, once for each mutant from `first` to `last` (0: the sound one), and prints
// a line for each: the firing that kills it and what was wrong, or that it survived.
module neuron_judge;
  `include "neuron_layout.vh"
  `include "neuron_memories.vh"
  localparam HAS_NORM = (OUTPUT != 1) && (NORMALISER != 0);
  localparam NORM_FRACTION = (WEIGHT_FRACTION > BIAS_FRACTION) ? WEIGHT_FRACTION : BIAS_FRACTION;
  localparam NORM_BITS = ACCUMULATOR_BITS - 1 - (ACCUMULATOR_FRACTION - NORM_FRACTION);
  localparam SHIFT_BITS = $clog2(NORM_BITS + 1);
  localparam KEPT_BITS = (NORMALISER == 1) ? SHIFT_BITS + RECIPROCAL_BITS : NORM_BITS;
  // docs/hardware/cycles.md
  localparam NORMALISE = !HAS_NORM ? 1 : (NORMALISER == 1) ? 2 : DRIVE_FRACTION + 2 + ((OUTPUT == 2) ? 1 : 0);
  localparam STAGE = NORMALISE + ((OUTPUT == 0 || OUTPUT == 3) ? 2 : 1) + PIPELINE;
  localparam MOST_CYCLES = 200;
  localparam signed [LINK_BITS-1:0] ONE_LINK = {{(LINK_BITS - 1) {1'b0}}, 1'b1} <<< LINK_FRACTION;

  reg clock = 0, add = 0, clear = 0, norms = 0, take = 0, take_norm = 0;
  reg signed [WEIGHT_BITS-1:0] weight_in = 0;
  reg signed [LINK_BITS-1:0] link_in = 0;
  reg signed [BIAS_BITS-1:0] bias_in = 0;
  reg [KEPT_BITS-1:0] kept = 0;
  reg signed [15:0] m = 0;
  reg signed [STATE_BITS-1:0] state_in = 0, point_in = 0;
  wire norm_ready, judged, free, publish, sum_negative, sum_zero;
  wire [KEPT_BITS-1:0] norm_kept;
  wire [ACCUMULATOR_BITS-2:0] size;
  wire signed [STATE_BITS:0] change_out;
  wire signed [STATE_BITS-1:0] new_state, new_point;
  wire signed [LINK_BITS-1:0] state_link, point_link;
  reg [9:0] mutant = 0;
  neuron neuron_under_test (
      .clock(clock),
      .add(add),
      .clear(clear),
      .norms(norms),
      .weight_in(weight_in),
      .link_in(link_in),
      .take(take),
      .take_norm(take_norm),
      .bias_in(bias_in),
      .kept(kept),
      .m(m),
      .state_in(state_in),
      .point_in(point_in),
      .norm_ready(norm_ready),
      .norm_kept(norm_kept),
      .judged(judged),
      .free(free),
      .size(size),
      .publish(publish),
      .sum_negative(sum_negative),
      .sum_zero(sum_zero),
      .change_out(change_out),
      .new_state(new_state),
      .new_point(new_point),
      .state_link(state_link),
      .point_link(point_link),
      .mutant(mutant)
  );

  integer n, t, waited, first, last, firing;
  reg wrong;
  reg [8*12:1] what;
  reg signed [ACCUMULATOR_BITS-1:0] s, s_size;
  reg signed [LINK_BITS-1:0] shown;

  task beat;
    begin
      #1 clock = 1;
      #1 clock = 0;
    end
  endtask
  task expect_equal(input ok, input [8*12:1] name);
    if (ok !== 1'b1 && !wrong) begin
      wrong = 1;
      what = name;
    end
  endtask

  // A row goes through the accumulator, tap by tap.
  task sum_row(input of_norms);
    integer count;
    begin
      norms = of_norms;
      count = taps[n];
      for (t = 0; t < count; t = t + 1) begin
        add = !(of_norms && OUTPUT == 2 && t != own[n]);
        weight_in = weight[n*WEIGHT_COUNT+t];
        link_in = link[n*LINK_COUNT+t];
        clear = t == count - 1;
        beat;
      end
      add = 0;
      clear = 0;
      norms = 0;
      // What stands there between rows matters to nobody.
      weight_in = {WEIGHT_BITS{1'b1}};
      link_in = {LINK_BITS{1'b1}};
    end
  endtask

  task prepare;
    begin
      sum_row(1);
      take_norm = 1;
      #1;
      waited = 0;
      while (norm_ready !== 1'b1 && waited < MOST_CYCLES) begin
        beat;
        take_norm = 0;
        #1 waited = waited + 1;
      end
      expect_equal(waited == ((NORMALISER == 1) ? RECIPROCAL_BITS : 0), "norm's time");
      if (NORMALISER == 1) expect_equal(norm_kept[RECIPROCAL_BITS-1:0] === reciprocal[n], "reciprocal");
      else expect_equal(norm_kept === norm[n], "norm");
      kept = norm_kept;
      beat;
      take_norm = 0;
    end
  endtask

  task fire;
    begin
      sum_row(0);
      s = sum[n*SUM_COUNT+SUM_COUNT-1];
      s_size = s < 0 ? -s : s;
      shown = (OUTPUT == 3) ? shown_point(point_in) : shown_point(state_in);
      take = 1;
      beat;
      take = 0;
      // Whoever comes next stands there already.
      state_in = {STATE_BITS{1'b1}};
      point_in = 0;
      kept = {KEPT_BITS{1'b1}};
      bias_in = {BIAS_BITS{1'b1}};
      #1;
      expect_equal(judged === 1'b1 && size === s_size[ACCUMULATOR_BITS-2:0], "|s|");
      expect_equal(free === !((shown == ONE_LINK && s >= 0) || (shown == -ONE_LINK && s <= 0)), "free");
      waited = 1;
      while (publish !== 1'b1 && waited < MOST_CYCLES) begin
        beat;
        #1 expect_equal(judged === 1'b0, "judged");
        waited = waited + 1;
      end
      expect_equal(waited == STAGE - ((STAGE == 1) ? 0 : 1), "stage's time");
      expect_equal(change_out === change[n], "change");
      expect_equal(new_state === state_after[n], "V");
      expect_equal(sum_negative === (s < 0) && sum_zero === (s == 0), "sign of s");
      if (OUTPUT == 3) expect_equal(new_point === extrapolated_after[n], "Y");
      if (OUTPUT == 3) expect_equal(state_link === shown_point(new_state), "V's link");
      expect_equal(((OUTPUT == 3) ? point_link : state_link) === link_after[n], "link");
      beat;
      #1 expect_equal(publish === 1'b0, "publish");
    end
  endtask

  // Q[V -> link], for the modes that presets have.
  function signed [LINK_BITS-1:0] shown_point(input signed [STATE_BITS-1:0] code);
    reg signed [STATE_BITS:0] wide;
    begin
      wide = code;
      if (STATE_FRACTION > LINK_FRACTION && LINK_ROUNDING == 0)
        wide = (wide + (1 <<< (STATE_FRACTION - LINK_FRACTION - 1))) >>> (STATE_FRACTION - LINK_FRACTION);
      else if (STATE_FRACTION > LINK_FRACTION && LINK_ROUNDING == 5) wide = wide >>> (STATE_FRACTION - LINK_FRACTION);
      shown_point = wide[LINK_BITS-1:0];
    end
  endfunction

  initial begin
    if (!$value$plusargs("first=%d", first)) first = 0;
    if (!$value$plusargs("last=%d", last)) last = 0;
    read_neurons;
    for (firing = first; firing <= last; firing = firing + 1) begin
      mutant = firing;
      wrong = 0;
      clear = 1;
      for (t = 0; t < 2 * MOST_CYCLES; t = t + 1) beat;
      clear = 0;
      for (n = 0; n < FIRINGS && !wrong; n = n + 1) begin
        bias_in = bias[n];
        kept = 0;
        if (HAS_NORM) prepare;
        bias_in = bias[n];
        m = momentum[n];
        state_in = state[n];
        point_in = (OUTPUT == 3) ? extrapolated[n] : state[n];
        fire;
      end
      if (wrong) $display("%0d killed by firing %0d: %0s", firing, n - 1, what);
      else $display("%0d survived", firing);
    end
    $finish;
  end
endmodule
