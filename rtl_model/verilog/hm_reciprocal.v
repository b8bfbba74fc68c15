// Prepares a reciprocal: r = floor(2^(B + M - 2) / N), where B is the bit length of N and M is MANTISSA, and how far
// N is shifted to the left until its highest bit is at the top. r = 0 stands for N = 0. A bit a cycle: N goes in, and
// M + 1 cycles later, in the cycle in which `ready` is 1, r stands at the output. PIPELINED = 1 takes an N every
// cycle, 0 takes the next one when the last is ready.
module hm_reciprocal #(
    parameter NORM_BITS = 24,
    parameter MANTISSA = 18,
    parameter SHIFT_BITS = 5,
    parameter PIPELINED = 1
) (
    input  wire                  clock,
    input  wire                  take,
    input  wire [ NORM_BITS-1:0] norm,
    output wire                  ready,
    output wire [  MANTISSA-1:0] mantissa,
    output wire [SHIFT_BITS-1:0] shift
);
  localparam REST_BITS = NORM_BITS + 1;
  localparam STEP_BITS = REST_BITS + 1;
  // One step of the division: {bit, rest}. A divisor whose highest bit is 0 is none.
  function [STEP_BITS-1:0] divided(input [REST_BITS-1:0] rest, input [NORM_BITS-1:0] divisor);
    reg fits;
    // verilator lint_off UNUSED
    reg [REST_BITS-1:0] left;
    // verilator lint_on UNUSED
    begin
      fits = divisor[NORM_BITS-1] & (rest >= {1'b0, divisor});
      left = fits ? rest - {1'b0, divisor} : rest;
      divided = {fits, left[REST_BITS-2:0], 1'b0};
    end
  endfunction

  // How far N lies below the top.
  function [SHIFT_BITS-1:0] leading_zeros(input [NORM_BITS-1:0] number);
    integer k;
    begin
      leading_zeros = {SHIFT_BITS{1'b0}};
      for (k = 0; k < NORM_BITS; k = k + 1)
        if (number[k]) leading_zeros = NORM_TOP[SHIFT_BITS-1:0] - k[SHIFT_BITS-1:0];
    end
  endfunction
  localparam [31:0] NORM_TOP = NORM_BITS - 1;

  wire [SHIFT_BITS-1:0] zeros = leading_zeros(norm);
  wire [ NORM_BITS-1:0] aligned = norm << zeros;
  localparam [REST_BITS-1:0] HALF = {2'b01, {(NORM_BITS - 1) {1'b0}}};

  generate
    if (PIPELINED != 0) begin : pipeline
      // Register k has k bits of the quotient.
      reg [MANTISSA*REST_BITS-1:0] rests = {(MANTISSA * REST_BITS) {1'b0}};
      reg [MANTISSA*NORM_BITS-1:0] divisors = {(MANTISSA * NORM_BITS) {1'b0}};
      reg [MANTISSA*MANTISSA-1:0] quotients = {(MANTISSA * MANTISSA) {1'b0}};
      reg [MANTISSA*SHIFT_BITS-1:0] shifts = {(MANTISSA * SHIFT_BITS) {1'b0}};
      reg [MANTISSA-1:0] valid = {MANTISSA{1'b0}};
      wire working = take | (|valid);
      integer k;
      always @(posedge clock) begin
        valid <= {valid[MANTISSA-2:0], take};
        if (working) begin
          rests[REST_BITS-1:0] <= HALF;
          quotients[MANTISSA-1:0] <= {MANTISSA{1'b0}};
          divisors <= {divisors[(MANTISSA-1)*NORM_BITS-1:0], aligned};
          shifts <= {shifts[(MANTISSA-1)*SHIFT_BITS-1:0], zeros};
          for (k = 1; k < MANTISSA; k = k + 1)
            {quotients[k*MANTISSA +: MANTISSA], rests[k*REST_BITS +: REST_BITS]} <= {
              quotients[(k-1)*MANTISSA +: MANTISSA-1],
              divided(rests[(k-1)*REST_BITS +: REST_BITS], divisors[(k-1)*NORM_BITS +: NORM_BITS])
            };
        end
      end
      // verilator lint_off UNUSED
      wire [STEP_BITS-1:0] last = divided(
          rests[(MANTISSA-1)*REST_BITS+:REST_BITS], divisors[(MANTISSA-1)*NORM_BITS+:NORM_BITS]
      );
      // verilator lint_on UNUSED
      assign ready = valid[MANTISSA-1];
      assign mantissa = {quotients[(MANTISSA-1)*MANTISSA+:MANTISSA-1], last[STEP_BITS-1]};
      assign shift = shifts[(MANTISSA-1)*SHIFT_BITS+:SHIFT_BITS];
    end else begin : serial
      reg [REST_BITS-1:0] rest = {REST_BITS{1'b0}};
      reg [NORM_BITS-1:0] divisor = {NORM_BITS{1'b0}};
      reg [MANTISSA-2:0] quotient = {(MANTISSA - 1) {1'b0}};
      reg [SHIFT_BITS-1:0] kept = {SHIFT_BITS{1'b0}};
      reg [MANTISSA-1:0] at = {MANTISSA{1'b0}};  // a 1 that walks
      wire [STEP_BITS-1:0] step = divided(rest, divisor);
      always @(posedge clock) begin
        at <= {at[MANTISSA-2:0], take};
        if (take) begin
          rest <= HALF;
          divisor <= aligned;
          kept <= zeros;
        end else if (|at) begin
          rest <= step[REST_BITS-1:0];
          quotient <= mantissa[MANTISSA-2:0];
        end
      end
      assign ready = at[MANTISSA-1];
      assign mantissa = {quotient, step[STEP_BITS-1]};
      assign shift = kept;
    end
  endgenerate
endmodule
