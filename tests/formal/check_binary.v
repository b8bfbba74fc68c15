// Binary outputs: V goes to where s points, stays where s is 0, and is told with its change.
module check_binary #(
    parameter STATE_BITS = 24,
    parameter STATE_FRACTION = 22
) (
    input wire                         negative,
    input wire                         zero,
    input wire signed [STATE_BITS-1:0] state
);
  wire signed [STATE_BITS:0] change;
  wire signed [STATE_BITS-1:0] new_state;
  hm_output_binary #(
      .STATE_BITS(STATE_BITS),
      .STATE_FRACTION(STATE_FRACTION)
  ) dut (
      .negative(negative),
      .zero(zero),
      .state(state),
      .change(change),
      .new_state(new_state)
  );
  localparam signed [STATE_BITS:0] ONE = {{STATE_BITS{1'b0}}, 1'b1} <<< STATE_FRACTION;
  wire signed [STATE_BITS:0] before = {state[STATE_BITS-1], state};
  wire signed [STATE_BITS:0] after = {new_state[STATE_BITS-1], new_state};
  always @* begin
    assume (!(zero && negative));
    assume (-ONE <= before && before <= ONE);
    assert (after - before == change);
    if (zero) assert (change == 0);
    else if (negative) assert (after == -ONE);
    else assert (after == ONE);
    assert (-ONE <= after && after <= ONE);
  end
endmodule
