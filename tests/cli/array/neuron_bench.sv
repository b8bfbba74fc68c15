// A core that is not ours, in Verilog: reads a blank folder of firings, computes each, and writes its answers
// into the folder. Written from docs/use/test-vectors.md and docs/hardware/datapath.md alone, for arrays with
// exact sums, reciprocals, and SC_RND with SC_SAT everywhere.
//   +firing=N +stage=K    in firing N, the K-th stage (1: s, then N, r, u, R, dV, V, link) is one too high
module neuron_bench;
  `include "neuron_layout.vh"
  `include "neuron_memories.vh"

  localparam UNIT = WEIGHT_FRACTION > BIAS_FRACTION ? WEIGHT_FRACTION : BIAS_FRACTION;
  localparam longint ONE_DRIVE = 64'sd1 <<< DRIVE_FRACTION, ONE_STATE = 64'sd1 <<< STATE_FRACTION;

  integer n, t, bits, down, fault_firing, fault_stage;
  longint s, total, r, u, pull_now, change_now, v;

  function longint rounded(input longint x, input integer places);
    rounded = places > 0 ? (x + (64'sd1 <<< (places - 1))) >>> places : x <<< -places;
  endfunction

  function longint saturated(input longint x, input integer width);
    saturated = x;
    if (x >= 64'sd1 <<< (width - 1)) saturated = (64'sd1 <<< (width - 1)) - 1;
    if (x < -(64'sd1 <<< (width - 1))) saturated = -(64'sd1 <<< (width - 1));
  endfunction

  function longint magnitude(input longint x);
    magnitude = x < 0 ? -x : x;
  endfunction

  function longint off(input integer stage);
    off = n == fault_firing && stage == fault_stage ? 1 : 0;
  endfunction

  // Sums after each beat, of one tap or several.
  task accumulate;
    begin
      s = longint'(bias[n]) <<< (ACCUMULATOR_FRACTION - BIAS_FRACTION);
      sum[n*SUM_COUNT] = s[SUM_WIDTH-1:0];
      total = magnitude(longint'(bias[n])) <<< (UNIT - BIAS_FRACTION);
      for (t = 0; t < TAPS; t = t + 1) begin
        s = s + ((longint'(weight[n*TAPS+t]) * longint'(link[n*TAPS+t])) <<<
                 (ACCUMULATOR_FRACTION - WEIGHT_FRACTION - LINK_FRACTION));
        total = total + (magnitude(longint'(weight[n*TAPS+t])) <<< (UNIT - WEIGHT_FRACTION));
        if (t == TAPS - 1) s = s + off(1);
        sum[n*SUM_COUNT+1+t/LANES] = s[SUM_WIDTH-1:0];
      end
      total = total + off(2);
      norm[n] = total[NORM_WIDTH-1:0];
    end
  endtask

  task normalise;
    begin
      bits = 0;
      r = 0;
      down = 0;
      u = 0;
      while ((total >>> bits) != 0) bits = bits + 1;
      if (total != 0) begin
        r = (64'sd1 <<< (bits + RECIPROCAL_BITS - 2)) / total + off(3);
        down = bits + RECIPROCAL_BITS - 2 - (DRIVE_FRACTION + UNIT - ACCUMULATOR_FRACTION);
        u = saturated(rounded(s * r, down), DRIVE_BITS);
      end
      reciprocal[n] = r[RECIPROCAL_WIDTH-1:0];
      places[n] = down;
      ratio[n] = u[RATIO_WIDTH-1:0];
      if (u > ONE_DRIVE) u = ONE_DRIVE;
      if (u < -ONE_DRIVE) u = -ONE_DRIVE;
      u = u + off(4);
      drive[n] = u[DRIVE_WIDTH-1:0];
    end
  endtask

  task move;
    begin
      pull_now = (u >= 0 ? ONE_STATE - longint'(state[n]) : ONE_STATE + longint'(state[n])) + off(5);
      pull[n] = pull_now[PULL_WIDTH-1:0];
      change_now = pull_now * u;
      product[n] = change_now[PRODUCT_WIDTH-1:0];
      change_now = rounded(change_now, DRIVE_FRACTION) + off(6);
      change[n] = change_now[CHANGE_WIDTH-1:0];
      v = longint'(state[n]) + change_now + off(7);
      state_after[n] = v[STATE_AFTER_WIDTH-1:0];
      extrapolated_after[n] = 0;
      v = rounded(v, STATE_FRACTION - LINK_FRACTION) + off(8);
      link_after[n] = v[LINK_AFTER_WIDTH-1:0];
    end
  endtask

  initial begin
    if ($value$plusargs("firing=%d", fault_firing) == 0) fault_firing = -1;
    if ($value$plusargs("stage=%d", fault_stage) == 0) fault_stage = 0;
    read_neurons;
    for (n = 0; n < FIRINGS; n = n + 1) begin
      accumulate;
      normalise;
      move;
    end
    $writememh({`NEURONS_DIR, "/sum.memh"}, sum);
    $writememh({`NEURONS_DIR, "/norm.memh"}, norm);
    $writememh({`NEURONS_DIR, "/reciprocal.memh"}, reciprocal);
    $writememh({`NEURONS_DIR, "/places.memh"}, places);
    $writememh({`NEURONS_DIR, "/ratio.memh"}, ratio);
    $writememh({`NEURONS_DIR, "/drive.memh"}, drive);
    $writememh({`NEURONS_DIR, "/pull.memh"}, pull);
    $writememh({`NEURONS_DIR, "/product.memh"}, product);
    $writememh({`NEURONS_DIR, "/change.memh"}, change);
    $writememh({`NEURONS_DIR, "/state_after.memh"}, state_after);
    $writememh({`NEURONS_DIR, "/extrapolated_after.memh"}, extrapolated_after);
    $writememh({`NEURONS_DIR, "/link_after.memh"}, link_after);
    $finish;
  end
endmodule
