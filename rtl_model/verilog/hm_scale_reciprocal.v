// u = |s| r 2^-places, rounded once and held within 2^UNIT; the sign goes beside it. FACTOR / 2^FACTOR_DOWN
// multiplies it: omega of projected outputs, else 1. A product (1 cycle), then its shift and rounding (1 cycle), with
// a register more in front of the first (FRONT = 1) and behind the shift (BEHIND_SHIFT = 1).
module hm_scale_reciprocal #(
    parameter SUM_BITS = 39,
    parameter MANTISSA = 18,
    parameter SHIFT_BITS = 5,
    parameter MOST_SHIFT = 23,       // of an N whose only bit is the last
    parameter DRIVE_FRACTION = 16,
    parameter DRIVE_MODE = 0,
    parameter UNIT = 16,             // the bound is 2^UNIT
    parameter BOUNDED = 1,           // |s| is never above what divides it
    parameter FACTOR = 1,
    parameter FACTOR_BITS = 1,
    parameter FACTOR_DOWN = 0,
    parameter FRONT = 0,
    parameter BEHIND_SHIFT = 0
) (
    input  wire                  clock,
    input  wire                  negative,
    input  wire [  SUM_BITS-2:0] size,
    input  wire [  MANTISSA-1:0] mantissa,
    input  wire [SHIFT_BITS-1:0] shift,
    output wire                  drive_negative,
    output wire [        UNIT:0] drive_size
);
  localparam SIZE_BITS = SUM_BITS - 1;
  localparam PRODUCT_BITS = SIZE_BITS + MANTISSA + ((FACTOR == 1) ? 0 : FACTOR_BITS);
  localparam ALIGNED_BITS = PRODUCT_BITS + ((BOUNDED != 0) ? 0 : MOST_SHIFT);
  // In the aligned product, N has its highest bit at the top: so many places down to the drive's last one.
  localparam DOWN = SIZE_BITS + MANTISSA - 2 - DRIVE_FRACTION + FACTOR_DOWN;
  localparam ROUNDED_BITS = ((ALIGNED_BITS - DOWN) < UNIT) ? UNIT + 2 : ALIGNED_BITS - DOWN + 2;
  localparam [31:0] OMEGA = FACTOR;

  wire front_negative, product_negative, shift_negative;
  wire [SIZE_BITS-1:0] front_size;
  wire [MANTISSA-1:0] front_mantissa;
  wire [SHIFT_BITS-1:0] front_shift, product_shift;
  wire [PRODUCT_BITS-1:0] product, kept_product;
  wire [ALIGNED_BITS-1:0] aligned, kept_aligned;
  wire [ROUNDED_BITS-1:0] rounded;

  hm_register #(
      .WIDTH(1 + SIZE_BITS + MANTISSA + SHIFT_BITS),
      .COUNT(FRONT)
  ) front (
      .clock(clock),
      .now  ({negative, size, mantissa, shift}),
      .later({front_negative, front_size, front_mantissa, front_shift})
  );

  wire [SIZE_BITS+MANTISSA-1:0] plain = {{MANTISSA{1'b0}}, front_size} * {{SIZE_BITS{1'b0}}, front_mantissa};
  generate
    if (FACTOR == 1) begin : no_factor
      assign product = plain;
    end else begin : factor
      assign product = {{FACTOR_BITS{1'b0}}, plain} * {{(SIZE_BITS + MANTISSA) {1'b0}}, OMEGA[FACTOR_BITS-1:0]};
    end
    if (BOUNDED != 0) begin : narrow
      assign aligned = kept_product << product_shift;
    end else begin : wide
      assign aligned = {{MOST_SHIFT{1'b0}}, kept_product} << product_shift;
    end
  endgenerate

  hm_register #(
      .WIDTH(1 + SHIFT_BITS + PRODUCT_BITS),
      .COUNT(1)
  ) multiplied (
      .clock(clock),
      .now  ({front_negative, front_shift, product}),
      .later({product_negative, product_shift, kept_product})
  );
  hm_register #(
      .WIDTH(1 + ALIGNED_BITS),
      .COUNT(BEHIND_SHIFT)
  ) shifted (
      .clock(clock),
      .now  ({product_negative, aligned}),
      .later({shift_negative, kept_aligned})
  );
  hm_round_places #(
      .FROM(ALIGNED_BITS),
      .DOWN(DOWN),
      .TO(ROUNDED_BITS),
      .MODE(DRIVE_MODE),
      .MAGNITUDE(1)
  ) round (
      .number(kept_aligned),
      .negative(shift_negative),
      .rounded(rounded)
  );
  wire beyond = (|rounded[ROUNDED_BITS-1:UNIT+1]) | (rounded[UNIT] & (|rounded[UNIT-1:0]));
  wire [UNIT:0] limited = beyond ? {1'b1, {UNIT{1'b0}}} : rounded[UNIT:0];
  hm_register #(
      .WIDTH(UNIT + 2),
      .COUNT(1)
  ) drive (
      .clock(clock),
      .now  ({shift_negative, limited}),
      .later({drive_negative, drive_size})
  );
endmodule
