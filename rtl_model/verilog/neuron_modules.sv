// The array with a module for every neuron, as one writes it first: all see the same sequencer and read each
// other's links by index. The mesh is built in, from the tables of array_pkg.
module neuron_modules
  import stages::*;
  import array_pkg::*;
(
    input logic clock,
    input logic write,
    input window_t window,
    input logic [31:0] address,
    input logic [31:0] word,
    input logic start,
    input logic [31:0] threshold,
    input logic [31:0] max_sweeps,
    output logic busy,
    output logic converged,
    output logic [31:0] sweeps,
    output logic [63:0] cycles,
    output logic [31:0] largest_change
);
  shared_wires wires (.clock);
  assign wires.write = write;
  assign wires.window = window;
  assign wires.address = address;
  assign wires.word = word;

  sequencer #(
      .PHASE_BITS(PHASE_BITS),
      .BEAT_BITS(BEAT_BITS),
      .RECIPROCAL_BITS(RECIPROCAL_BITS)
  ) steps (
      .last_phase(PHASE_BITS'(PHASES - 1)),
      .row_beats(BEAT_BITS'(PHASE_TAPS[wires.phase])),
      .most_beats(BEAT_BITS'(MOST_TAPS)),
      .stage(wires.stage),
      .phase(wires.phase),
      .beat(wires.beat),
      .*
  );
  assign busy = wires.stage != IDLE;

  logic [PHASE_BITS-1:0] fires_in[NEURONS];

  for (genvar i = 0; i < NEURONS; ++i) begin : g
    neuron #(
        .INDEX(i),
        .PHASE(PHASE_OF[i]),
        .ROW(ROW_OF[i]),
        .ROW_TAPS(TAPS_OF[i])
    ) n (
        .wires
    );
    initial fires_in[i] = PHASE_BITS'(PHASE_OF[i]);
  end

  // ---- convergence detector
  logic [31:0] largest;
  logic signed [31:0] moved;

  always_ff @(posedge clock)
    if (wires.stage == PUBLISH) begin
      largest = wires.phase == 0 ? '0 : largest_change;
      for (int i = 0; i < NEURONS; ++i) begin
        moved = 32'(wires.delta[i]);
        if (moved < 0) moved = -moved;
        if (fires_in[i] == wires.phase && moved > largest) largest = moved;
      end
      largest_change <= largest;
    end

endmodule
