// Rounding by places: in every mode, of magnitudes with a sign beside them and of two's complement.
module check_round #(
    parameter FROM = 41,
    parameter DOWN = 16,
    parameter TO = 26,
    parameter MODE = 0,
    parameter MAGNITUDE = 1
) (
    input wire [FROM-1:0] number,
    input wire            negative
);
  localparam WIDE = FROM + TO + 2;
  wire [TO-1:0] rounded;
  hm_round_places #(
      .FROM(FROM),
      .DOWN(DOWN),
      .TO(TO),
      .MODE(MODE),
      .MAGNITUDE(MAGNITUDE)
  ) dut (
      .number(number),
      .negative(negative),
      .rounded(rounded)
  );
  wire number_sign = (MAGNITUDE != 0) ? 1'b0 : number[FROM-1];
  wire rounded_sign = (MAGNITUDE != 0) ? 1'b0 : rounded[TO-1];
  wire turned = (MAGNITUDE != 0) & negative;
  wire signed [WIDE-1:0] x_size = {{(WIDE - FROM) {number_sign}}, number};
  wire signed [WIDE-1:0] q_size = {{(WIDE - TO) {rounded_sign}}, rounded};
  wire signed [WIDE-1:0] x = turned ? -x_size : x_size;
  wire signed [WIDE-1:0] q = turned ? -q_size : q_size;
  localparam signed [WIDE-1:0] PLACE = {{(WIDE - 1) {1'b0}}, 1'b1} <<< DOWN;
  wire right;
  rounding #(
      .WIDE(WIDE),
      .MODE(MODE)
  ) rule (
      .negative(x < 0),
      .odd(q[0]),
      .off(x - (q <<< DOWN)),
      .place(PLACE),
      .right(right)
  );
  always @* assert (right);
endmodule
