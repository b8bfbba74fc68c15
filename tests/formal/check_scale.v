// u = |s| r 2^-places, rounded once and held within 2^UNIT: given the product |s| r (cut: any number), its shift, its
// rounding by the rule, and its bound. BOUNDED says that |s| <= N, so that |s| r <= 2^(W + M - 2 - shift) and no bit
// of the shifted product is lost.
module check_scale #(
    parameter SUM_BITS = 39,
    parameter MANTISSA = 18,
    parameter SHIFT_BITS = 5,
    parameter MOST_SHIFT = 23,
    parameter DRIVE_FRACTION = 16,
    parameter DRIVE_MODE = 0,
    parameter UNIT = 16,
    parameter BOUNDED = 1
) (
    input wire                  clock,
    input wire                  negative,
    input wire [  SUM_BITS-2:0] size,
    input wire [  MANTISSA-1:0] mantissa,
    input wire [SHIFT_BITS-1:0] shift
);
  localparam SIZE_BITS = SUM_BITS - 1;
  localparam PRODUCT_BITS = SIZE_BITS + MANTISSA;
  localparam DOWN = SIZE_BITS + MANTISSA - 2 - DRIVE_FRACTION;
  localparam WIDE = PRODUCT_BITS + MOST_SHIFT + 4;
  localparam signed [WIDE-1:0] PLACE = {{(WIDE - 1) {1'b0}}, 1'b1} <<< DOWN;
  localparam [UNIT:0] ONE = {1'b1, {UNIT{1'b0}}};
  wire drive_negative;
  wire [UNIT:0] drive_size;
  hm_scale_reciprocal #(
      .SUM_BITS(SUM_BITS),
      .MANTISSA(MANTISSA),
      .SHIFT_BITS(SHIFT_BITS),
      .MOST_SHIFT(MOST_SHIFT),
      .DRIVE_FRACTION(DRIVE_FRACTION),
      .DRIVE_MODE(DRIVE_MODE),
      .UNIT(UNIT),
      .BOUNDED(BOUNDED)
  ) dut (
      .clock(clock),
      .negative(negative),
      .size(size),
      .mantissa(mantissa),
      .shift(shift),
      .drive_negative(drive_negative),
      .drive_size(drive_size)
  );
  wire [PRODUCT_BITS-1:0] s_r = {{MANTISSA{1'b0}}, size} * {{SIZE_BITS{1'b0}}, mantissa};
  wire [WIDE-1:0] wide_product = {{(WIDE - PRODUCT_BITS) {1'b0}}, s_r};
  reg first = 0, out = 0;
  reg kept_negative, minus;
  reg [WIDE-1:0] product, moved;
  reg [SHIFT_BITS-1:0] kept_shift;
  always @(posedge clock) begin
    {out, first} <= {first, 1'b1};
    {minus, kept_negative} <= {kept_negative, negative};
    product <= wide_product;
    kept_shift <= shift;
    moved <= product << kept_shift;
  end
  wire signed [WIDE-1:0] x = minus ? -moved : moved;
  wire signed [WIDE-1:0] u = {{(WIDE - UNIT - 1) {1'b0}}, drive_size};
  wire signed [WIDE-1:0] q = minus ? -u : u;
  wire is_right;
  rounding #(
      .WIDE(WIDE),
      .MODE(DRIVE_MODE)
  ) rule (
      .negative(x < 0),
      .odd(q[0]),
      .off(x - (q <<< DOWN)),
      .place(PLACE),
      .right(is_right)
  );
  always @* begin
    assume (shift <= MOST_SHIFT);
    if (BOUNDED != 0) assume ((wide_product << shift) <= (PLACE << DRIVE_FRACTION));
    if (out) begin
      assert (drive_negative == minus);
      assert (drive_size <= ONE);
      assert ((moved >= (PLACE << UNIT)) ? drive_size == ONE : is_right);
    end
  end
endmodule
