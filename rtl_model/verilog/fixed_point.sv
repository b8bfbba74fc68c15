// Arithmetic that the Verilog models share: rounding with SystemC's modes, bit length (docs/hardware/datapath.md).
package fixed_point;

  // In SystemC's order (sc_q_mode), as rtl_model/spec/number_format.h numbers them.
  typedef enum int {RND, RND_ZERO, RND_MIN_INF, RND_INF, RND_CONV, TRN, TRN_ZERO} rounding_t;

  // x * 2^-places, rounded. A place that is lost and a half decide whether the floor goes up by one.
  function automatic logic signed [63:0] round_places(input logic signed [63:0] x, input int unsigned places,
                                                      input int mode);
    logic signed [63:0] floor;
    logic half, below, up; // the first bit that is lost; any further one
    floor = x >>> places;
    half = places != 0 && x[6'(places - 1)];
    below = places > 1 && (x & ~(64'hFFFFFFFFFFFFFFFF << (places - 1))) != 0;
    case (mode)
      RND: up = half;
      RND_ZERO: up = half && (below || x < 0);
      RND_MIN_INF: up = half && below;
      RND_INF: up = half && (below || x >= 0);
      RND_CONV: up = half && (below || floor[0]);
      TRN_ZERO: up = x < 0 && (half || below);
      default: up = 1'b0;
    endcase
    return floor + 64'(up);
  endfunction

  function automatic logic [31:0] magnitude(input logic signed [31:0] x);
    return x < 0 ? -x : x;
  endfunction

  // Bits up to the highest set one; 0 for 0.
  function automatic logic [5:0] bit_length(input logic [31:0] x);
    logic [31:0] rest;
    logic [5:0] n;
    rest = x;
    n = '0;
    if (rest[31:16] != 0) begin n += 6'd16; rest >>= 16; end
    if (rest[15:8] != 0) begin n += 6'd8; rest >>= 8; end
    if (rest[7:4] != 0) begin n += 6'd4; rest >>= 4; end
    if (rest[3:2] != 0) begin n += 6'd2; rest >>= 2; end
    if (rest[1]) return n + 6'd2;
    return n + 6'(rest[0]);
  endfunction

endpackage
