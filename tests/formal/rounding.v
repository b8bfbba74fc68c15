// What rounding means, by inequalities alone: x over `place` is rounded to the whole number q exactly where x - q
// place = `off` lies where the mode wants it. There is exactly one such q in every mode, so whoever obeys this
// computes docs/hardware/number-formats.md. Modes bear SystemC's numbers.
module rounding #(
    parameter WIDE = 40,
    parameter MODE = 0
) (
    input  wire                   negative,  // x is below zero
    input  wire                   odd,       // q is
    input  wire signed [WIDE-1:0] off,
    input  wire signed [WIDE-1:0] place,     // above zero
    output reg                    right
);
  wire signed [WIDE:0] twice = {off, 1'b0};
  wire signed [WIDE:0] whole = {place[WIDE-1], place};
  wire near = (-whole <= twice) & (twice <= whole);
  wire low_tie = twice == -whole;   // x was half-way, and went up
  wire high_tie = twice == whole;   // x was half-way, and went down
  always @*
    case (MODE)
      0: right = near & ~high_tie;
      1: right = near & ~(negative ? high_tie : low_tie);
      2: right = near & ~low_tie;
      3: right = near & ~(negative ? low_tie : high_tie);
      4: right = near & ~((low_tie | high_tie) & odd);
      5: right = (off >= 0) & (off < place);
      default: right = negative ? (off > -place) & (off <= 0) : (off >= 0) & (off < place);
    endcase
endmodule
