// Walks a run (docs/hardware/cycles.md): take START, prepare, phase after phase, convergence check, sweep after sweep.
// What it shows is the work of the cycle that the next edge ends.
module sequencer
  import stages::*;
#(
    parameter int PHASE_BITS = 4,
    parameter int BEAT_BITS = 6,
    parameter int RECIPROCAL_BITS = 18
) (
    input logic clock,
    input logic start,
    input logic [31:0] threshold,
    input logic [31:0] max_sweeps,
    input logic [PHASE_BITS-1:0] last_phase,
    input logic [BEAT_BITS-1:0] row_beats,   // of the longest row that fires in this phase
    input logic [BEAT_BITS-1:0] most_beats,  // of the longest row of the array
    input logic [31:0] largest_change,       // of this sweep so far
    output stage_t stage,
    output logic [PHASE_BITS-1:0] phase,
    output logic [BEAT_BITS-1:0] beat,
    output logic converged,
    output logic [31:0] sweeps,
    output logic [63:0] cycles
);

  initial stage = IDLE;

  always_ff @(posedge clock) begin
    if (stage != IDLE) cycles <= cycles + 1;
    beat <= beat + 1'b1;
    case (stage)
      SUM_NORM: if (beat == most_beats - 1'b1) begin
          stage <= DIVIDE;
          beat <= '0;
        end
      DIVIDE: if (beat == BEAT_BITS'(RECIPROCAL_BITS - 1)) stage <= STORE;
      STORE: begin
        stage <= ACCUMULATE;
        beat <= '0;
      end
      ACCUMULATE: if (beat == row_beats - 1'b1) stage <= MULTIPLY;
      MULTIPLY: stage <= ROUND;
      ROUND: stage <= PULL;
      PULL: stage <= PUBLISH;
      PUBLISH: begin
        stage <= phase == last_phase ? CHECK : ACCUMULATE;
        phase <= phase == last_phase ? '0 : phase + 1'b1;
        beat <= '0;
      end
      CHECK: begin
        sweeps <= sweeps + 1;
        converged <= largest_change <= threshold;
        stage <= largest_change <= threshold || sweeps + 1 >= max_sweeps ? IDLE : ACCUMULATE;
        beat <= '0;
      end
      default: if (start) begin  // this cycle counts: it takes START
          stage <= SUM_NORM;
          phase <= '0;
          beat <= '0;
          converged <= 1'b0;
          sweeps <= '0;
          cycles <= 64'd1;
        end
    endcase
  end

endmodule
