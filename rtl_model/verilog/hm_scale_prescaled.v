// u of rows that the host has divided: s rounded to the drive, brought into the drive's range by its overflow mode
// (0 SC_SAT, 1 SC_SAT_ZERO, 2 SC_SAT_SYM, 3 SC_WRAP), then held within 1. A cycle, and one more with a register
// behind the rounding (BEHIND_ROUNDING = 1).
module hm_scale_prescaled #(
    parameter SUM_BITS = 39,
    parameter DOWN = 13,
    parameter DRIVE_BITS = 18,
    parameter DRIVE_FRACTION = 16,
    parameter DRIVE_MODE = 0,
    parameter DRIVE_OVERFLOW = 0,
    parameter BEHIND_ROUNDING = 0
) (
    input  wire                    clock,
    input  wire                    negative,
    input  wire [    SUM_BITS-2:0] size,
    output wire                    drive_negative,
    output wire [DRIVE_FRACTION:0] drive_size
);
  localparam SIZE_BITS = SUM_BITS - 1;
  localparam LEFT_BITS = SIZE_BITS - DOWN;
  localparam ROUNDED_BITS = ((LEFT_BITS > DRIVE_BITS) ? LEFT_BITS : DRIVE_BITS) + 2;
  wire [ROUNDED_BITS-1:0] rounded, size_in_range;
  wire in_range_negative, range_negative;
  wire [ROUNDED_BITS-1:0] range_size;

  hm_round_places #(
      .FROM(SIZE_BITS),
      .DOWN(DOWN),
      .TO(ROUNDED_BITS),
      .MODE(DRIVE_MODE),
      .MAGNITUDE(1)
  ) round (
      .number(size),
      .negative(negative),
      .rounded(rounded)
  );
  generate
    if (DRIVE_OVERFLOW == 1) begin : zero
      // The least code is one further from 0 than the largest.
      localparam [ROUNDED_BITS-1:0] END = {{(ROUNDED_BITS - 1) {1'b0}}, 1'b1} << (DRIVE_BITS - 1);
      wire fits = (rounded < END) | (negative & (rounded == END));
      assign size_in_range = fits ? rounded : {ROUNDED_BITS{1'b0}};
      assign in_range_negative = negative;
    end else if (DRIVE_OVERFLOW == 3) begin : wrap
      // verilator lint_off UNUSED
      wire [ROUNDED_BITS-1:0] code = negative ? -rounded : rounded;
      // verilator lint_on UNUSED
      wire [DRIVE_BITS-1:0] cut = code[DRIVE_BITS-1:0];
      assign in_range_negative = cut[DRIVE_BITS-1];
      assign size_in_range = {{(ROUNDED_BITS - DRIVE_BITS) {1'b0}}, in_range_negative ? -cut : cut};
    end else begin : saturate
      // Both ends of the range lie beyond 1, where the limiter stops.
      assign size_in_range = rounded;
      assign in_range_negative = negative;
    end
  endgenerate
  hm_register #(
      .WIDTH(ROUNDED_BITS + 1),
      .COUNT(BEHIND_ROUNDING)
  ) ranged (
      .clock(clock),
      .now  ({in_range_negative, size_in_range}),
      .later({range_negative, range_size})
  );
  wire beyond = (|range_size[ROUNDED_BITS-1:DRIVE_FRACTION+1]) |
                (range_size[DRIVE_FRACTION] & (|range_size[DRIVE_FRACTION-1:0]));
  wire [DRIVE_FRACTION:0] limited = beyond ? {1'b1, {DRIVE_FRACTION{1'b0}}} : range_size[DRIVE_FRACTION:0];
  hm_register #(
      .WIDTH(DRIVE_FRACTION + 2),
      .COUNT(1)
  ) drive (
      .clock(clock),
      .now  ({range_negative, limited}),
      .later({drive_negative, drive_size})
  );
endmodule
