// Which way a number goes that lies between two codes: 1 to the upper one. The modes bear SystemC's numbers
// (docs/hardware/number-formats.md). MAGNITUDE = 1: the number is a magnitude with a sign beside it, and "up" is
// away from zero. MAGNITUDE = 0: two's complement, and "up" is towards plus infinity.
module hm_round #(
    parameter MODE = 0,
    parameter MAGNITUDE = 1
) (
    input  wire negative,
    input  wire odd,     // last bit that is kept
    input  wire half,    // first bit that is dropped
    input  wire sticky,  // any bit behind it
    output wire up
);
  localparam RND = 0, RND_ZERO = 1, RND_MIN_INF = 2, RND_INF = 3, RND_CONV = 4, TRN = 5;

  wire beyond = half & sticky;
  wire tie = half & ~sticky;
  wire rest = half | sticky;
  // Of a tie, and of any rest, by whoever asks: the way to plus infinity leads away from zero for positive numbers.
  wire tie_up = (MAGNITUDE != 0) ? ~negative : 1'b1;
  wire tie_down = (MAGNITUDE != 0) ? negative : 1'b0;
  wire tie_out = (MAGNITUDE != 0) ? 1'b1 : ~negative;
  wire tie_in = (MAGNITUDE != 0) ? 1'b0 : negative;

  assign up = (MODE == RND) ? (beyond | (tie & tie_up)) :
              (MODE == RND_ZERO) ? (beyond | (tie & tie_in)) :
              (MODE == RND_MIN_INF) ? (beyond | (tie & tie_down)) :
              (MODE == RND_INF) ? (beyond | (tie & tie_out)) :
              (MODE == RND_CONV) ? (beyond | (tie & odd)) :
              (MODE == TRN) ? (rest & tie_down) : (rest & tie_in);
endmodule
