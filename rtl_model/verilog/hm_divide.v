// u = FACTOR |s| / (N 2^FACTOR_DOWN) by long division, rounded once and held within 2^UNIT; the sign goes beside it.
// A bit of the quotient a cycle, from that of 2^UNIT down to the drive's last, then the rounding (1 cycle), with a
// register more in front (FRONT = 1) and behind the comparison of the rest (BEHIND_REST = 1). PIPELINED = 1 takes a
// sum every cycle; 0 has a single subtractor and takes the next one when u is written.
module hm_divide #(
    parameter SUM_BITS = 39,
    parameter NORM_BITS = 24,
    parameter NORM_UP = 14,          // from the point of N to that of s
    parameter UNIT = 16,
    parameter DRIVE_FRACTION = 16,
    parameter DRIVE_MODE = 0,
    parameter FACTOR = 1,
    parameter FACTOR_BITS = 1,
    parameter FACTOR_DOWN = 0,
    parameter FRONT = 0,
    parameter BEHIND_REST = 0,
    parameter PIPELINED = 1
) (
    input  wire                 clock,
    input  wire                 take,
    input  wire                 negative,
    input  wire [ SUM_BITS-2:0] size,
    input  wire [NORM_BITS-1:0] norm,
    output wire                 drive_negative,
    output wire [       UNIT:0] drive_size
);
  localparam STEPS = UNIT + 1;
  localparam ABOVE = UNIT - DRIVE_FRACTION;  // the first bit of the quotient counts 2^ABOVE
  localparam SIZE_BITS = SUM_BITS - 1 + ((FACTOR == 1) ? 0 : FACTOR_BITS);
  localparam DIVISOR_BITS = NORM_BITS + NORM_UP + FACTOR_DOWN + ABOVE;
  localparam REST_BITS = ((SIZE_BITS > DIVISOR_BITS) ? SIZE_BITS : DIVISOR_BITS) + 1;
  localparam [31:0] OMEGA = FACTOR;
  localparam STEP_BITS = REST_BITS + 1;

  // {bit, rest}. Once the first bit is 1, u is at its bound and the further bits do not count.
  function [STEP_BITS-1:0] divided(input [REST_BITS-1:0] rest, input [DIVISOR_BITS-1:0] divisor);
    reg fits;
    // verilator lint_off UNUSED
    reg [REST_BITS-1:0] left;
    // verilator lint_on UNUSED
    begin
      fits = rest >= {{(REST_BITS - DIVISOR_BITS) {1'b0}}, divisor};
      left = fits ? rest - {{(REST_BITS - DIVISOR_BITS) {1'b0}}, divisor} : rest;
      divided = {fits, left[REST_BITS-2:0], 1'b0};
    end
  endfunction

  wire front_negative, front_take;
  wire [SUM_BITS-2:0] front_size;
  wire [NORM_BITS-1:0] front_norm;
  hm_register #(
      .WIDTH(2 + SUM_BITS - 1 + NORM_BITS),
      .COUNT(FRONT)
  ) front (
      .clock(clock),
      .now  ({take, negative, size, norm}),
      .later({front_take, front_negative, front_size, front_norm})
  );
  // Nothing divides by 0: where N is 0, whoever asks makes u by the sign of s.
  wire [NORM_BITS-1:0] not_zero = front_norm | {{(NORM_BITS - 1) {1'b0}}, ~|front_norm};
  wire [DIVISOR_BITS-1:0] divisor = {{(DIVISOR_BITS - NORM_BITS) {1'b0}}, not_zero} << (NORM_UP + FACTOR_DOWN + ABOVE);
  wire [SIZE_BITS-1:0] dividend;
  wire [REST_BITS-1:0] rest = {{(REST_BITS - SIZE_BITS) {1'b0}}, dividend};
  wire [STEP_BITS-1:0] first = divided(rest, divisor);

  wire last_negative;
  wire [STEPS-1:0] last_quotient;
  wire [REST_BITS-1:0] last_rest;
  wire [DIVISOR_BITS-1:0] last_divisor;

  generate
    if (FACTOR == 1) begin : no_factor
      assign dividend = front_size;
    end else begin : factor
      assign dividend = {{FACTOR_BITS{1'b0}}, front_size} * {{(SUM_BITS - 1) {1'b0}}, OMEGA[FACTOR_BITS-1:0]};
    end
    if (PIPELINED != 0) begin : pipeline
      // Register k has k + 1 bits of the quotient.
      reg [STEPS*REST_BITS-1:0] rests = {(STEPS * REST_BITS) {1'b0}};
      reg [STEPS*DIVISOR_BITS-1:0] divisors = {(STEPS * DIVISOR_BITS) {1'b0}};
      reg [STEPS*STEPS-1:0] quotients = {(STEPS * STEPS) {1'b0}};
      reg [STEPS-1:0] signs = {STEPS{1'b0}};
      reg [STEPS-1:0] valid = {STEPS{1'b0}};
      wire working = front_take | (|valid);
      integer k;
      always @(posedge clock) begin
        valid <= {valid[STEPS-2:0], front_take};
        if (working) begin
          signs <= {signs[STEPS-2:0], front_negative};
          divisors <= {divisors[(STEPS-1)*DIVISOR_BITS-1:0], divisor};
          {quotients[STEPS-1:0], rests[REST_BITS-1:0]} <= {{(STEPS - 1) {1'b0}}, first};
          for (k = 1; k < STEPS; k = k + 1)
            {quotients[k*STEPS +: STEPS], rests[k*REST_BITS +: REST_BITS]} <= {
              quotients[(k-1)*STEPS +: STEPS-1],
              divided(rests[(k-1)*REST_BITS +: REST_BITS], divisors[(k-1)*DIVISOR_BITS +: DIVISOR_BITS])
            };
        end
      end
      assign last_negative = signs[STEPS-1];
      assign last_quotient = quotients[(STEPS-1)*STEPS+:STEPS];
      assign last_rest = rests[(STEPS-1)*REST_BITS+:REST_BITS];
      assign last_divisor = divisors[(STEPS-1)*DIVISOR_BITS+:DIVISOR_BITS];
    end else begin : serial
      reg [REST_BITS-1:0] kept_rest = {REST_BITS{1'b0}};
      reg [DIVISOR_BITS-1:0] kept_divisor = {DIVISOR_BITS{1'b0}};
      reg [STEPS-1:0] quotient = {STEPS{1'b0}};
      reg sign = 1'b0;
      // verilator lint_off UNUSED
      reg [STEPS-1:0] at = {STEPS{1'b0}};  // a 1 that walks
      wire [STEPS-1:0] bits = front_take ? {STEPS{1'b0}} : quotient;
      // verilator lint_on UNUSED
      wire [STEP_BITS-1:0] step = front_take ? first : divided(kept_rest, kept_divisor);
      always @(posedge clock) begin
        at <= {at[STEPS-2:0], front_take};
        if (front_take) begin
          kept_divisor <= divisor;
          sign <= front_negative;
        end
        if (front_take | (|at[STEPS-2:0])) begin
          kept_rest <= step[REST_BITS-1:0];
          quotient <= {bits[STEPS-2:0], step[STEP_BITS-1]};
        end
      end
      assign last_negative = sign;
      assign last_quotient = quotient;
      assign last_rest = kept_rest;
      assign last_divisor = kept_divisor;
    end
  endgenerate

  // The rest is doubled already.
  wire [REST_BITS-1:0] compared = {{(REST_BITS - DIVISOR_BITS) {1'b0}}, last_divisor};
  wire half = last_rest >= compared;
  wire sticky = (last_rest != compared) & (|last_rest);
  wire round_negative, round_half, round_sticky, up;
  wire [STEPS-1:0] round_quotient;
  hm_register #(
      .WIDTH(3 + STEPS),
      .COUNT(BEHIND_REST)
  ) judged (
      .clock(clock),
      .now  ({last_negative, half, sticky, last_quotient}),
      .later({round_negative, round_half, round_sticky, round_quotient})
  );
  hm_round #(
      .MODE(DRIVE_MODE),
      .MAGNITUDE(1)
  ) round (
      .negative(round_negative),
      .odd(round_quotient[0]),
      .half(round_half),
      .sticky(round_sticky),
      .up(up)
  );
  wire [UNIT:0] rounded = round_quotient[UNIT] ? {1'b1, {UNIT{1'b0}}} : round_quotient + {{UNIT{1'b0}}, up};
  hm_register #(
      .WIDTH(UNIT + 2),
      .COUNT(1)
  ) drive (
      .clock(clock),
      .now  ({round_negative, rounded}),
      .later({drive_negative, drive_size})
  );
endmodule
