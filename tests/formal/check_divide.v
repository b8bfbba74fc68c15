// u = FACTOR |s| / (N 2^FACTOR_DOWN), rounded once and held within 2^UNIT, for every s and N, at any width. `dut` is
// hm_divide with its registers as ports. Beside every stage goes what the bits of its quotient so far, the highest
// first, make of the divisor: that is what quotient times divisor is. With what is left, stage by stage, it adds up to
// what is divided. At the end u is the quotient or the next one, and the rule of rounding says which.
module check_divide #(
    parameter SUM_BITS = 39,
    parameter NORM_BITS = 24,
    parameter NORM_UP = 14,
    parameter UNIT = 16,
    parameter DRIVE_FRACTION = 16,
    parameter DRIVE_MODE = 0,
    parameter FACTOR = 1,
    parameter FACTOR_BITS = 1,
    parameter FACTOR_DOWN = 0,
    parameter PIPELINED = 1
) (
    input wire                 clock,
    input wire                 take,
    input wire                 negative,
    input wire [ SUM_BITS-2:0] size,
    input wire [NORM_BITS-1:0] norm
);
  localparam STEPS = UNIT + 1;
  localparam COPIES = (PIPELINED != 0) ? STEPS : 1;
  localparam ABOVE = UNIT - DRIVE_FRACTION;
  localparam SIZE_BITS = SUM_BITS - 1 + ((FACTOR == 1) ? 0 : FACTOR_BITS);
  localparam DIVISOR_BITS = NORM_BITS + NORM_UP + FACTOR_DOWN + ABOVE;
  localparam REST_BITS = ((SIZE_BITS > DIVISOR_BITS) ? SIZE_BITS : DIVISOR_BITS) + 1;
  localparam WIDE = REST_BITS + UNIT + 4;
  wire drive_negative;
  wire [UNIT:0] drive_size;
  wire [COPIES*REST_BITS-1:0] rests;
  wire [COPIES*DIVISOR_BITS-1:0] divisors;
  wire [COPIES*STEPS-1:0] quotients;
  wire [COPIES-1:0] signs;
  wire [STEPS-1:0] walks;

  // What is divided, and by what.
  wire [SIZE_BITS-1:0] dividend;
  generate
    if (FACTOR == 1) begin : plain
      assign dividend = size;
    end else begin : with_factor
      localparam [FACTOR_BITS-1:0] OMEGA = FACTOR;
      assign dividend = {{FACTOR_BITS{1'b0}}, size} * {{(SUM_BITS - 1) {1'b0}}, OMEGA};
    end
  endgenerate
  wire [DIVISOR_BITS-1:0] divisor = {{(DIVISOR_BITS - NORM_BITS) {1'b0}}, norm} << (NORM_UP + FACTOR_DOWN + ABOVE);

  function fits(input [REST_BITS-1:0] rest, input [DIVISOR_BITS-1:0] by);
    fits = rest >= {{(REST_BITS - DIVISOR_BITS) {1'b0}}, by};
  endfunction
  function [WIDE-1:0] wide(input [DIVISOR_BITS-1:0] by);
    wide = {{(WIDE - DIVISOR_BITS) {1'b0}}, by};
  endfunction
  // Whether all is right in a stage with k + 1 bits of the quotient. Where the first bit is 1, u is at its bound.
  function right(input integer k, input [SIZE_BITS-1:0] whole, input [DIVISOR_BITS-1:0] by,
                 input [REST_BITS-1:0] rest, input [WIDE-1:0] product, input at_bound);
    reg [WIDE-1:0] doubled;
    begin
      doubled = {{(WIDE - SIZE_BITS) {1'b0}}, whole} << (k + 1);
      right = at_bound == (whole >= by);
      if (!at_bound)
        right = right & ((product << 1) <= doubled) & (rest == doubled - (product << 1)) & (rest < (wide(by) << 1));
    end
  endfunction

  reg [COPIES*SIZE_BITS-1:0] n = 0;
  reg [COPIES*DIVISOR_BITS-1:0] d = 0;
  reg [COPIES*WIDE-1:0] products = 0;
  reg [COPIES*STEPS-1:0] bits = 0;
  reg [COPIES-1:0] minus = 0;
  reg [STEPS-1:0] taken = 0;
  reg out = 0;
  // Of the neuron whose u is in the register now.
  reg [SIZE_BITS-1:0] last_n;
  reg [DIVISOR_BITS-1:0] last_d;
  reg [WIDE-1:0] last_product;
  reg [STEPS-1:0] last_bits;
  reg last_minus;
  always @(posedge clock) begin
    taken <= {taken[STEPS-2:0], take};
    out <= taken[STEPS-1];
    last_n <= n[(COPIES-1)*SIZE_BITS+:SIZE_BITS];
    last_d <= d[(COPIES-1)*DIVISOR_BITS+:DIVISOR_BITS];
    last_product <= products[(COPIES-1)*WIDE+:WIDE];
    last_bits <= bits[(COPIES-1)*STEPS+:STEPS];
    last_minus <= minus[COPIES-1];
  end

  wire up = drive_size != last_bits;
  wire signed [WIDE:0] whole = {1'b0, {(WIDE - SIZE_BITS) {1'b0}}, last_n} << UNIT;
  wire signed [WIDE:0] made = {1'b0, last_product} + (up ? {1'b0, wide(last_d)} : 0);
  wire signed [WIDE:0] off = last_minus ? made - whole : whole - made;
  wire is_right;
  rounding #(
      .WIDE(WIDE + 1),
      .MODE(DRIVE_MODE)
  ) rule (
      .negative(last_minus && last_n != 0),
      .odd(drive_size[0]),
      .off(off),
      .place({1'b0, wide(last_d)}),
      .right(is_right)
  );
  always @* begin
    assume (norm != 0);
    if (out) begin
      assert (drive_negative == last_minus);
      if (last_bits[UNIT]) assert (drive_size == {1'b1, {UNIT{1'b0}}} && last_n >= last_d);
      else begin
        assert (drive_size == last_bits || drive_size == last_bits + 1);
        assert (is_right);
      end
    end
  end

  integer k;
  generate
    if (PIPELINED != 0) begin : pipeline
      dut dut (
          .clock(clock),
          .take(take),
          .negative(negative),
          .size(size),
          .norm(norm),
          .drive_negative(drive_negative),
          .drive_size(drive_size),
          .\pipeline.rests (rests),
          .\pipeline.divisors (divisors),
          .\pipeline.quotients (quotients),
          .\pipeline.signs (signs),
          .\pipeline.valid (walks)
      );
      always @(posedge clock)
        if (take | (|walks)) begin
          n <= {n[(STEPS-1)*SIZE_BITS-1:0], dividend};
          d <= {d[(STEPS-1)*DIVISOR_BITS-1:0], divisor};
          minus <= {minus[STEPS-2:0], negative};
          products[WIDE-1:0] <= (dividend >= divisor) ? wide(divisor) : 0;
          bits[STEPS-1:0] <= {{(STEPS - 1) {1'b0}}, dividend >= divisor};
          for (k = 1; k < STEPS; k = k + 1) begin
            products[k*WIDE+:WIDE] <= (products[(k-1)*WIDE+:WIDE] << 1) +
                (fits(rests[(k-1)*REST_BITS+:REST_BITS], d[(k-1)*DIVISOR_BITS+:DIVISOR_BITS]) ? wide(
                d[(k-1)*DIVISOR_BITS+:DIVISOR_BITS]) : 0);
            bits[k*STEPS+:STEPS] <= {bits[(k-1)*STEPS+:STEPS-1],
                fits(rests[(k-1)*REST_BITS+:REST_BITS], d[(k-1)*DIVISOR_BITS+:DIVISOR_BITS])};
          end
        end
      always @* begin
        assert (walks == taken);
        assert (divisors == d);
        assert (quotients == bits);
        assert (signs == minus);
        for (k = 0; k < STEPS; k = k + 1)
          assert (!taken[k] || right(k, n[k*SIZE_BITS+:SIZE_BITS], d[k*DIVISOR_BITS+:DIVISOR_BITS],
              rests[k*REST_BITS+:REST_BITS], products[k*WIDE+:WIDE], bits[k*STEPS+k]));
      end
    end else begin : serial
      dut dut (
          .clock(clock),
          .take(take),
          .negative(negative),
          .size(size),
          .norm(norm),
          .drive_negative(drive_negative),
          .drive_size(drive_size),
          .\serial.kept_rest (rests),
          .\serial.kept_divisor (divisors),
          .\serial.quotient (quotients),
          .\serial.sign (signs),
          .\serial.at (walks)
      );
      always @(posedge clock)
        if (take) begin
          n <= dividend;
          d <= divisor;
          minus <= negative;
          products <= (dividend >= divisor) ? wide(divisor) : 0;
          bits <= {{(STEPS - 1) {1'b0}}, dividend >= divisor};
        end else if (|walks[STEPS-2:0]) begin
          products <= (products << 1) + (fits(rests, d) ? wide(d) : 0);
          bits <= {bits[STEPS-2:0], fits(rests, d)};
        end
      always @* begin
        // The next sum comes when the last has gone.
        assume (!take || walks[STEPS-2:0] == 0);
        assert (walks == taken);
        assert ((walks & (walks - 1)) == 0);
        if (|walks) assert (divisors == d && quotients == bits && signs == minus);
        for (k = 0; k < STEPS; k = k + 1)
          if (walks[k]) assert (bits >> k <= 1 && right(k, n, d, rests, products, bits[k]));
      end
    end
  endgenerate
endmodule
