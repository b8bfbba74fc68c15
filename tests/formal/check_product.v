// A product of R and a u that is at most 1 is at most R, at any width. `product` is what the bits of u so far, the
// highest first, make of R: that is what a product is. `low` is R 2^bits - product, and stays above 0 as long as a bit
// of u is 0; where the first is 1, u is 1 and the rest are 0.
module check_product #(
    parameter R_BITS = 25,
    parameter PLACES = 16
) (
    input wire clock,
    input wire bit_of_u
);
  localparam WIDE = R_BITS + PLACES + 3;
  (* anyconst *) reg [R_BITS-1:0] r;
  (* anyconst *) reg is_one;  // the bit of 1 is set, and by u <= 1 no other
  wire [WIDE-1:0] wide_r = {{(WIDE - R_BITS) {1'b0}}, r};
  reg begun = 0;
  reg [WIDE-1:0] product, power;
  reg [PLACES:0] at = 1;  // a 1 that walks with the bits behind that of 1
  wire next = bit_of_u & ~is_one;
  wire ends = at[PLACES];
  always @(posedge clock) begin
    begun <= 1;
    if (!begun) begin
      product <= is_one ? wide_r : 0;
      power <= wide_r;
    end else if (!ends) begin
      product <= (product << 1) + (next ? wide_r : 0);
      power <= power << 1;
      at <= at << 1;
    end
  end
  wire [WIDE-1:0] whole = wide_r << PLACES;
  integer k;
  reg [WIDE-1:0] right_power;
  always @* begin
    right_power = 0;
    for (k = 0; k <= PLACES; k = k + 1) if (at[k]) right_power = wide_r << k;
    if (begun) begin
      assert (|at && !(at & (at - 1)));
      assert (power == right_power);
      assert (product <= power);
      assert (is_one ? product == power : product + wide_r <= power);
      if (ends) assert (product <= whole);
    end else assert (at == 1);
  end
endmodule
