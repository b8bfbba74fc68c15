// A number over 2^DOWN, rounded; the result must fit TO bits. MAGNITUDE = 1: `number` is a magnitude, whose sign
// is `negative`. MAGNITUDE = 0: two's complement, and `negative` is not looked at. DOWN below zero multiplies.
module hm_round_places #(
    parameter FROM = 8,
    parameter DOWN = 2,
    parameter TO = 8,
    parameter MODE = 0,
    parameter MAGNITUDE = 1
) (
    // verilator lint_off UNUSED
    input  wire [FROM-1:0] number,
    input  wire            negative,
    // verilator lint_on UNUSED
    output wire [  TO-1:0] rounded
);
  // Room for whatever is shifted or kept: further bits are the sign's.
  localparam ROOM = FROM + TO + ((DOWN < 0) ? -DOWN : DOWN) + 1;
  wire sign = (MAGNITUDE != 0) ? 1'b0 : number[FROM-1];
  // verilator lint_off UNUSED
  wire [ROOM-1:0] wide = {{(ROOM - FROM) {sign}}, number};
  // verilator lint_on UNUSED
  generate
    if (DOWN <= 0) begin : exact
      // verilator lint_off UNUSED
      wire [ROOM-1:0] moved = wide << (-DOWN);
      // verilator lint_on UNUSED
      assign rounded = moved[TO-1:0];
    end else begin : lossy
      wire sticky;
      wire up;
      if (DOWN > 1) begin : behind
        assign sticky = |wide[DOWN-2:0];
      end else begin : nothing
        assign sticky = 1'b0;
      end
      hm_round #(
          .MODE(MODE),
          .MAGNITUDE(MAGNITUDE)
      ) round (
          .negative((MAGNITUDE != 0) ? negative : sign),
          .odd(wide[DOWN]),
          .half(wide[DOWN-1]),
          .sticky(sticky),
          .up(up)
      );
      assign rounded = wide[DOWN+TO-1:DOWN] + {{(TO - 1) {1'b0}}, up};
    end
  endgenerate
endmodule
