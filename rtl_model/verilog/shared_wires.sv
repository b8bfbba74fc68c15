// What the neurons of an array share: where the run stands, every V as its neighbours see it, and the host's
// side. Links and deltas are written in one stage and read in another, so blocking assignments cannot race.
interface shared_wires
  import stages::*;
  import array_pkg::*;
(
    input logic clock
);
  stage_t stage;
  logic [PHASE_BITS-1:0] phase;
  logic [BEAT_BITS-1:0] beat;
  logic signed [LINK_BITS-1:0] link[NEURONS];
  logic signed [STATE_BITS-1:0] state[NEURONS] /*verilator public_flat_rd*/;
  logic signed [STATE_BITS:0] delta[NEURONS];
  logic write;
  window_t window;
  logic [31:0] address, word;
endinterface
