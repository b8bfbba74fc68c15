// u of rows that the host has divided: s rounded, brought into the range of the drive by its overflow mode, held within
// 1. `code` is what the solver likes, as long as it is s rounded by the rule.
module check_prescaled #(
    parameter SUM_BITS = 24,
    parameter DOWN = 5,
    parameter DRIVE_BITS = 12,
    parameter DRIVE_FRACTION = 10,
    parameter DRIVE_MODE = 0,
    parameter DRIVE_OVERFLOW = 0
) (
    input wire                       clock,
    input wire                       negative,
    input wire        [SUM_BITS-2:0] size,
    input wire signed [  SUM_BITS:0] code
);
  localparam WIDE = SUM_BITS + DRIVE_BITS + 4;
  localparam signed [WIDE-1:0] PLACE = {{(WIDE - 1) {1'b0}}, 1'b1} <<< DOWN;
  localparam signed [WIDE-1:0] ONE = {{(WIDE - 1) {1'b0}}, 1'b1} <<< DRIVE_FRACTION;
  localparam signed [WIDE-1:0] END = {{(WIDE - 1) {1'b0}}, 1'b1} <<< (DRIVE_BITS - 1);
  wire drive_negative;
  wire [DRIVE_FRACTION:0] drive_size;
  hm_scale_prescaled #(
      .SUM_BITS(SUM_BITS),
      .DOWN(DOWN),
      .DRIVE_BITS(DRIVE_BITS),
      .DRIVE_FRACTION(DRIVE_FRACTION),
      .DRIVE_MODE(DRIVE_MODE),
      .DRIVE_OVERFLOW(DRIVE_OVERFLOW)
  ) dut (
      .clock(clock),
      .negative(negative),
      .size(size),
      .drive_negative(drive_negative),
      .drive_size(drive_size)
  );
  wire signed [WIDE-1:0] wide_size = {{(WIDE - SUM_BITS + 1) {1'b0}}, size};
  wire signed [WIDE-1:0] x = negative ? -wide_size : wide_size;
  wire signed [WIDE-1:0] q = {{(WIDE - SUM_BITS - 1) {code[SUM_BITS]}}, code};
  wire signed [DRIVE_BITS-1:0] cut = q[DRIVE_BITS-1:0];
  wire fits = (q < END) & (q >= -END);
  wire signed [WIDE-1:0] wrapped = {{(WIDE - DRIVE_BITS) {cut[DRIVE_BITS-1]}}, cut};
  wire signed [WIDE-1:0] least = (DRIVE_OVERFLOW == 2) ? 1 - END : -END;
  wire signed [WIDE-1:0] ranged = (DRIVE_OVERFLOW == 3) ? wrapped : (DRIVE_OVERFLOW == 1) ? (fits ? q : 0) :
      (q >= END) ? END - 1 : (q < least) ? least : q;
  wire signed [WIDE-1:0] limited = (ranged > ONE) ? ONE : (ranged < -ONE) ? -ONE : ranged;
  wire is_code;
  rounding #(
      .WIDE(WIDE),
      .MODE(DRIVE_MODE)
  ) rule (
      .negative(x < 0),
      .odd(q[0]),
      .off(x - (q <<< DOWN)),
      .place(PLACE),
      .right(is_code)
  );
  reg out = 0;
  reg signed [WIDE-1:0] right;
  always @(posedge clock) begin
    out <= 1;
    right <= limited;
  end
  wire signed [WIDE-1:0] u = {{(WIDE - DRIVE_FRACTION - 1) {1'b0}}, drive_size};
  always @* begin
    assume (is_code);
    if (out) assert ((drive_negative ? -u : u) == right);
  end
endmodule
