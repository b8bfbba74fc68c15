// DONE comes, in the very cycle of docs/hardware/cycles.md: of a folded array with a shared stage and a network of two
// phases (two rounds, then one), whatever V does, wherever an ABORT comes, for at most two sweeps.
module check_sequencer #(
    parameter STAGE_CYCLES = 4,
    parameter PREPARE_DEPTH = 3
) (
    input wire       clock,
    input wire       cut_short,
    input wire [4:0] largest_change,
    input wire [6:0] largest_sum
);
  // Two lines and two neurons, a line and a neuron; two lines and a neuron.
  localparam [4:0] ENDS_ROUND = 5'b10110, ENDS_PHASE = 5'b10100, ENDS_SWEEP = 5'b10000;
  localparam FIRST = 2, SECOND = 1, THIRD = 2;  // lines of the rounds
  localparam PHASES = (1 + FIRST + 2 + 1 - 1 + STAGE_CYCLES) + (1 + THIRD + 1 - 1 + STAGE_CYCLES);
  localparam PREPARE = 1 + FIRST + 2 + THIRD + 1 - 1 + PREPARE_DEPTH;
  localparam SWEEP = PHASES + 1;
  localparam MOST = 1 + PREPARE + 2 * SWEEP;
  wire [2:0] line_address;
  wire [1:0] round_address;
  reg [2:0] line_at = 0;
  reg [1:0] round_at = 0;
  reg [6:0] at = 0;
  always @(posedge clock) begin
    line_at <= line_address;
    round_at <= round_address;
    if (at != 127) at <= at + 1;
  end
  (* anyconst *) reg [31:0] most_sweeps, threshold;
  (* anyconst *) reg by_sum;
  (* anyconst *) reg [63:0] floor;
  wire done, running, aborted, converged;
  wire [31:0] sweeps;
  wire [63:0] cycles;
  hm_sequencer #(
      .SHARED(1),
      .STAGE_CYCLES(STAGE_CYCLES),
      .HAS_PREPARE(1),
      .PREPARE_DEPTH(PREPARE_DEPTH),
      .LINE_BITS(3),
      .ROUND_BITS(2),
      .COUNT_BITS(2),
      .STATE_BITS(4),
      .SUM_BITS(8)
  ) dut (
      .clock(clock),
      .begin_run(at == 0),
      .begin_reset(1'b0),
      .cut_short(cut_short & (at != 0)),
      .reset_cycles(32'd4),
      .threshold(threshold),
      .most_sweeps(most_sweeps),
      .stop_by_sum(by_sum),
      .stop_share(6'd0),
      .sum_threshold(floor),
      .last_entry(8'd0),
      .wrong_way(1'b0),
      .line_ends_round(ENDS_ROUND[line_at]),
      .line_ends_phase(ENDS_PHASE[line_at]),
      .line_ends_sweep(ENDS_SWEEP[line_at]),
      .round_count((round_at == 0) ? 2'd2 : 2'd1),
      .round_ends_phase(round_at != 0),
      .round_ends_sweep(round_at == 2),
      .line_address(line_address),
      .round_address(round_address),
      .largest_change(largest_change),
      .largest_sum(largest_sum),
      .done(done),
      .running(running),
      .aborted(aborted),
      .converged(converged),
      .sweeps(sweeps),
      .cycles(cycles)
  );
  // What went wrong on the way is asked at the end, in a single query.
  reg ended = 0, bad = 0;
  wire right_end = !ended && cycles == {57'd0, at} && sweeps <= 2 && {25'd0, at} == 1 + PREPARE + sweeps * SWEEP;
  always @(posedge clock) begin
    ended <= ended | done;
    bad <= bad | (done & ~right_end) | (ended & running);
  end
  always @* begin
    assume (most_sweeps <= 2);
    // The run begins in cycle 1 of this clock; its last cycle has number MOST of them.
    if (at == MOST + 2) assert (ended && !bad);
  end
endmodule
