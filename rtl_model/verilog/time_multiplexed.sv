// The array on ELEMENTS processing elements that take turns: in phase k, element e is neuron number e of that
// phase. Written for speed in simulation (docs/findings/performance.md): one process, loops over arrays. Which neuron
// is where, who reads whom, how long phases are: all loaded, so one model serves every mesh that fits.
//
// The memories are written with blocking assignments: this process alone reads and writes them, and the simulator
// takes no others in loops. What it reads of the sequencer are registers, as they were before the edge. Codes
// stand sign-extended in 32 or 64 bits, because cutting each to its format costs a third of the speed; none is
// wider than its format says (docs/hardware/datapath.md), so a synthesizer may narrow them.
module time_multiplexed
  import stages::*;
  import fixed_point::*;
  import array_pkg::*;
(
    input logic clock,
    input logic write,
    input window_t window,
    input logic [31:0] address,  // {phase, beat, element} of a weight or source, {phase, element} of others
    input logic [31:0] word,
    input logic start,
    input logic [31:0] threshold,
    input logic [31:0] max_sweeps,
    output logic busy,
    output logic converged,
    output logic [31:0] sweeps,
    output logic [63:0] cycles,
    output logic [31:0] largest_change,
    output logic [31:0] elements  // how many there are
);
  localparam int ELEMENT_BITS = $clog2(ELEMENTS);
  localparam int TAP_BITS = $clog2(TAPS), SLOT_BITS = PHASE_BITS + ELEMENT_BITS;
  localparam int DEPTH = 2 ** ELEMENT_BITS;
  localparam int STATE_ONE = 2 ** STATE_FRACTION, DRIVE_ONE = 2 ** DRIVE_FRACTION;

  // ---- sequencer
  stage_t stage;
  logic [PHASE_BITS-1:0] phase, last_phase;
  logic [BEAT_BITS-1:0] beat, most_beats;
  logic [BEAT_BITS-1:0] row_beats[2**PHASE_BITS];

  sequencer #(
      .PHASE_BITS(PHASE_BITS),
      .BEAT_BITS(BEAT_BITS),
      .RECIPROCAL_BITS(RECIPROCAL_BITS)
  ) steps (
      .row_beats(row_beats[phase]),
      .*
  );
  assign busy = stage != IDLE;
  assign elements = ELEMENTS;

  // ---- memories: a line holds what all elements need in one beat, or keep from one phase to the next
  logic signed [31:0] weight[2**(PHASE_BITS+TAP_BITS)][DEPTH];
  logic [SLOT_BITS-1:0] source[2**(PHASE_BITS+TAP_BITS)][DEPTH];  // {phase, element} of the link to take
  logic signed [31:0] link[2**SLOT_BITS];
  logic signed [31:0] bias[2**PHASE_BITS][DEPTH];
  logic signed [31:0] state[2**PHASE_BITS][DEPTH] /*verilator public_flat_rd*/;
  logic [31:0] norm[2**PHASE_BITS][DEPTH], rest[2**PHASE_BITS][DEPTH];
  logic [31:0] reciprocal[2**PHASE_BITS][DEPTH];
  logic [31:0] places[2**PHASE_BITS][DEPTH];

  // ---- registers of the elements
  logic signed [63:0] sum[DEPTH], product[DEPTH];
  logic signed [31:0] drive[DEPTH], delta[DEPTH];
  logic [31:0] largest;

  // ---- phase
  task automatic begin_sum();
    for (int unsigned e = 0; e < ELEMENTS; ++e) sum[e] = 64'(bias[phase][e]) <<< BIAS_UP;
  endtask

  task automatic accumulate(input logic [PHASE_BITS+TAP_BITS-1:0] line);
    for (int unsigned e = 0; e < ELEMENTS; ++e) begin
      logic signed [31:0] w, l;
      w = 32'(weight[line][e]);
      l = 32'(link[source[line][e]]);
      sum[e] += 64'(w * l) <<< PRODUCT_UP;
    end
  endtask

  task automatic multiply();
    for (int unsigned e = 0; e < ELEMENTS; ++e) product[e] = sum[e] * signed'(64'(reciprocal[phase][e]));
  endtask

  task automatic normalise();
    for (int unsigned e = 0; e < ELEMENTS; ++e) begin
      logic signed [63:0] ratio;
      ratio = round_places(product[e], places[phase][e], DRIVE_ROUNDING);
      drive[e] = ratio > 64'(DRIVE_ONE) ? DRIVE_ONE : ratio < -64'(DRIVE_ONE) ? -DRIVE_ONE : 32'(ratio);
    end
  endtask

  task automatic pull();
    for (int unsigned e = 0; e < ELEMENTS; ++e) begin
      logic signed [31:0] r;
      r = drive[e] >= 0 ? STATE_ONE - state[phase][e] : STATE_ONE + state[phase][e];
      delta[e] = 32'(round_places(64'(r) * 64'(drive[e]), DRIVE_FRACTION, STATE_ROUNDING));
    end
  endtask

  task automatic publish();
    for (int unsigned e = 0; e < ELEMENTS; ++e) begin
      logic [31:0] change;
      change = delta[e] < 0 ? -delta[e] : delta[e];
      if (change > largest) largest = change;
      state[phase][e] += delta[e];
      link[{phase, ELEMENT_BITS'(e)}] = link_of(state[phase][e]);
    end
  endtask

  function automatic logic signed [31:0] link_of(input logic signed [31:0] v);
    return 32'(round_places(64'(v), STATE_FRACTION - LINK_FRACTION, LINK_ROUNDING));
  endfunction

  // ---- prepare: for all neurons at once
  task automatic begin_norm(input logic [PHASE_BITS-1:0] p);
    for (int unsigned e = 0; e < ELEMENTS; ++e)
      norm[p][e] = (bias[p][e] < 0 ? -bias[p][e] : bias[p][e]) << BIAS_NORM_UP;
  endtask

  task automatic add_norm(input logic [PHASE_BITS-1:0] p, input logic [PHASE_BITS+TAP_BITS-1:0] line);
    for (int unsigned e = 0; e < ELEMENTS; ++e) begin
      logic signed [31:0] w;
      w = 32'(weight[line][e]);
      norm[p][e] += (w < 0 ? -w : w) << WEIGHT_NORM_UP;
    end
  endtask

  task automatic begin_division(input logic [PHASE_BITS-1:0] p);
    for (int unsigned e = 0; e < ELEMENTS; ++e) begin
      places[p][e] = 32'(bit_length(norm[p][e])) + RECIPROCAL_BITS - 2 - RATIO_UP;
      rest[p][e] = (32'd1 << bit_length(norm[p][e])) >> 1;
      reciprocal[p][e] = 0;
    end
  endtask

  task automatic divide(input logic [PHASE_BITS-1:0] p);
    for (int unsigned e = 0; e < ELEMENTS; ++e) begin
      logic fits;
      fits = rest[p][e] >= norm[p][e];
      rest[p][e] = (rest[p][e] - (fits ? norm[p][e] : 0)) << 1;
      reciprocal[p][e] = {reciprocal[p][e][30:0], fits};
    end
  endtask

  always_ff @(posedge clock)
    case (stage)
      ACCUMULATE: begin
        if (beat == 0) begin_sum();
        accumulate({phase, beat[TAP_BITS-1:0]});
      end
      MULTIPLY: multiply();
      ROUND: normalise();
      PULL: pull();
      PUBLISH: begin
        largest = phase == 0 ? '0 : largest_change;
        publish();
        largest_change <= largest;
      end
      SUM_NORM: for (int unsigned p = 0; p <= 32'(last_phase); ++p) begin
        if (beat == 0) begin_norm(PHASE_BITS'(p));
        add_norm(PHASE_BITS'(p), {PHASE_BITS'(p), beat[TAP_BITS-1:0]});
      end
      DIVIDE: for (int unsigned p = 0; p <= 32'(last_phase); ++p) begin
        if (beat == 0) begin_division(PHASE_BITS'(p));
        divide(PHASE_BITS'(p));
      end
      IDLE: if (write) load();
      default: ;
    endcase

  task automatic load();
    logic [PHASE_BITS+TAP_BITS-1:0] line;
    logic [PHASE_BITS-1:0] p;
    logic [ELEMENT_BITS-1:0] e;
    logic signed [31:0] v;
    line = address[SLOT_BITS+TAP_BITS-1:ELEMENT_BITS];
    p = address[SLOT_BITS-1:ELEMENT_BITS];
    e = address[ELEMENT_BITS-1:0];
    v = 32'(signed'(word[STATE_BITS-1:0]));
    case (window)
      WEIGHT: weight[line][e] = 32'(signed'(word[WEIGHT_BITS-1:0]));
      SOURCE: source[line][e] = SLOT_BITS'(word);
      BIAS: bias[p][e] = 32'(signed'(word[BIAS_BITS-1:0]));
      OUTPUT: begin
        state[p][e] = v > STATE_ONE ? STATE_ONE : v < -STATE_ONE ? -STATE_ONE : v;
        link[{p, e}] = link_of(state[p][e]);
      end
      ROW_BEATS: row_beats[p] = word[BEAT_BITS-1:0];
      LAST_PHASE: last_phase = word[PHASE_BITS-1:0];
      default: most_beats = word[BEAT_BITS-1:0];
    endcase
  endtask

endmodule
