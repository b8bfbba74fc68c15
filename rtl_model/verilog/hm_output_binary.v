// The sign of s as an output: V goes to 1 or -1 at once, and stays where s is 0. No cycle of its own but that in which
// V is written.
module hm_output_binary #(
    parameter STATE_BITS = 24,
    parameter STATE_FRACTION = 22
) (
    input  wire                         negative,
    input  wire                         zero,
    input  wire signed [STATE_BITS-1:0] state,
    output wire signed [  STATE_BITS:0] change,
    output wire signed [STATE_BITS-1:0] new_state
);
  localparam signed [STATE_BITS-1:0] ONE = {{(STATE_BITS - 1) {1'b0}}, 1'b1} <<< STATE_FRACTION;
  assign new_state = zero ? state : negative ? -ONE : ONE;
  assign change = {new_state[STATE_BITS-1], new_state} - {state[STATE_BITS-1], state};
endmodule
