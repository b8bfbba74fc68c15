// A two-part neuron as a module of its own (docs/hardware/datapath.md): input accumulator, reciprocal, output stage.
// The neuron knows its place in the mesh from the tables of array_pkg. What another stage reads is written by blocking
// assignments, which spare the simulator a shadow of each.
module neuron
  import stages::*;
  import fixed_point::*;
  import array_pkg::*;
#(
    parameter int INDEX = 0,
    parameter int PHASE = 0,
    parameter int ROW = 0,  // its first weight, and its first source in TAP_SOURCE
    parameter int ROW_TAPS = 3
) (
    shared_wires wires
);
  localparam logic signed [STATE_BITS:0] STATE_ONE = 2 ** STATE_FRACTION;
  localparam logic signed [DRIVE_BITS-1:0] DRIVE_ONE = 2 ** DRIVE_FRACTION;

  logic signed [WEIGHT_BITS-1:0] weight[ROW_TAPS];
  logic signed [BIAS_BITS-1:0] bias;
  logic signed [ACCUMULATOR_BITS-1:0] sum;
  logic [NORM_BITS-1:0] norm;
  logic [NORM_BITS:0] rest;
  logic [RECIPROCAL_BITS-1:0] reciprocal;
  logic [5:0] places;
  logic signed [ACCUMULATOR_BITS+RECIPROCAL_BITS-1:0] product;
  logic signed [DRIVE_BITS-1:0] drive;

  function automatic logic signed [DRIVE_BITS-1:0] limited(input logic signed [63:0] ratio);
    if (ratio > 64'(DRIVE_ONE)) return DRIVE_ONE;
    if (ratio < -64'(DRIVE_ONE)) return -DRIVE_ONE;
    return DRIVE_BITS'(ratio);
  endfunction

  function automatic logic signed [STATE_BITS-1:0] within_one(input logic signed [STATE_BITS-1:0] v);
    if (v > STATE_BITS'(STATE_ONE)) return STATE_BITS'(STATE_ONE);
    if (v < -STATE_BITS'(STATE_ONE)) return -STATE_BITS'(STATE_ONE);
    return v;
  endfunction

  function automatic logic signed [LINK_BITS-1:0] link_of(input logic signed [STATE_BITS-1:0] v);
    return LINK_BITS'(round_places(64'(v), STATE_FRACTION - LINK_FRACTION, LINK_ROUNDING));
  endfunction

  // ---- phase: a row shorter than the phase's longest waits with its sum
  logic signed [31:0] tap;
  logic signed [STATE_BITS:0] v, r;
  logic signed [63:0] moved;

  always_ff @(posedge wires.clock)
    if (wires.phase == PHASE_BITS'(PHASE))
      case (wires.stage)
        ACCUMULATE:
        if (wires.beat < BEAT_BITS'(ROW_TAPS)) begin
          tap = 32'(weight[wires.beat]) * 32'(wires.link[TAP_SOURCE[ROW+32'(wires.beat)]]);
          sum <= (wires.beat == 0 ? ACCUMULATOR_BITS'(bias) <<< BIAS_UP : sum)
              + (ACCUMULATOR_BITS'(tap) <<< PRODUCT_UP);
        end
        MULTIPLY: product <= (ACCUMULATOR_BITS + RECIPROCAL_BITS)'(64'(sum) * signed'(64'(reciprocal)));
        ROUND: drive <= limited(round_places(64'(product), 32'(places), DRIVE_ROUNDING));
        PULL: begin
          v = (STATE_BITS + 1)'(wires.state[INDEX]);
          r = drive >= 0 ? STATE_ONE - v : STATE_ONE + v;
          moved = round_places(64'(r) * 64'(drive), DRIVE_FRACTION, STATE_ROUNDING);
          wires.delta[INDEX] = (STATE_BITS + 1)'(moved);
        end
        PUBLISH: begin
          wires.state[INDEX] = wires.state[INDEX] + STATE_BITS'(wires.delta[INDEX]);
          wires.link[INDEX] = link_of(wires.state[INDEX]);
        end
        default: ;
      endcase

  // ---- prepare: N, then a bit of its reciprocal a beat, beginning at the highest bit of N
  logic [5:0] norm_length;
  logic [NORM_BITS:0] remainder;
  logic fits;

  always_ff @(posedge wires.clock)
    if (wires.stage == SUM_NORM)
      if (wires.beat < BEAT_BITS'(ROW_TAPS))
        norm = (wires.beat == 0 ? NORM_BITS'(magnitude(32'(bias))) << BIAS_NORM_UP : norm)
            + (NORM_BITS'(magnitude(32'(weight[wires.beat]))) << WEIGHT_NORM_UP);

  always_ff @(posedge wires.clock)
    if (wires.stage == DIVIDE) begin
      remainder = rest;
      if (wires.beat == 0) begin
        norm_length = bit_length(32'(norm));
        places <= norm_length + 6'(RECIPROCAL_BITS - 2 - RATIO_UP);
        remainder = (NORM_BITS + 1)'((64'd1 << norm_length) >> 1);
      end
      fits = remainder >= (NORM_BITS + 1)'(norm);
      reciprocal <= {reciprocal[RECIPROCAL_BITS-2:0], fits};
      rest <= (fits ? remainder - (NORM_BITS + 1)'(norm) : remainder) << 1;
    end

  // ---- the host writes only between runs
  always_ff @(posedge wires.clock)
    if (wires.stage == IDLE) begin
      if (wires.write && wires.window == WEIGHT && wires.address - ROW < ROW_TAPS)
        weight[wires.address-ROW] = WEIGHT_BITS'(wires.word);
      if (wires.write && wires.window == BIAS && wires.address == INDEX) bias = BIAS_BITS'(wires.word);
      if (wires.write && wires.window == OUTPUT && wires.address == INDEX) begin
        wires.state[INDEX] = within_one(STATE_BITS'(wires.word));
        wires.link[INDEX] = link_of(wires.state[INDEX]);
      end
    end

endmodule
