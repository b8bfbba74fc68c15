// r = floor(2^(B + M - 2) / N), for every N, at any width, M cycles behind the cycle behind `take`. `dut` is
// hm_reciprocal with its registers as ports. Beside every stage goes what the bits of its quotient so far, the highest
// first, make of the divisor: that is what quotient times divisor is. With what is left, stage by stage, it adds up to
// the power of two that is divided. So r d + left = 2^(W + M - 2) with 0 <= left < d at the end, where W is NORM_BITS
// and d = N 2^(W - B).
module check_reciprocal #(
    parameter NORM_BITS = 24,
    parameter MANTISSA = 18,
    parameter SHIFT_BITS = 5,
    parameter PIPELINED = 1
) (
    input wire                  clock,
    input wire                  take,
    input wire [ NORM_BITS-1:0] norm,
    input wire [SHIFT_BITS-1:0] zeros  // what the solver likes, as long as N so far to the left begins with a 1
);
  localparam REST_BITS = NORM_BITS + 1;
  localparam WIDE = NORM_BITS + MANTISSA + 3;
  localparam COPIES = (PIPELINED != 0) ? MANTISSA : 1;
  wire ready;
  wire [MANTISSA-1:0] mantissa;
  wire [SHIFT_BITS-1:0] shift;
  wire [COPIES*REST_BITS-1:0] rests;
  wire [COPIES*NORM_BITS-1:0] divisors;
  wire [COPIES*SHIFT_BITS-1:0] shifts;
  wire [COPIES*MANTISSA-1:0] quotients;
  wire [MANTISSA-1:0] walks;  // a 1 for every N on its way

  wire [NORM_BITS-1:0] aligned = norm << zeros;
  wire is_zeros = (norm == 0) ? zeros == 0 : aligned[NORM_BITS-1] & ((aligned >> zeros) == norm);

  // What goes beside: N as it went in, d, and by how much; product and quotient of the bits so far.
  reg [COPIES*NORM_BITS-1:0] n = 0, d = 0;
  reg [COPIES*SHIFT_BITS-1:0] z = 0;
  reg [COPIES*WIDE-1:0] products = 0;
  reg [COPIES*MANTISSA-1:0] bits = 0;
  reg [MANTISSA-1:0] taken = 0;
  reg [MANTISSA*NORM_BITS-1:0] history = 0;
  always @(posedge clock) begin
    taken <= {taken[MANTISSA-2:0], take};
    history <= {history[(MANTISSA-1)*NORM_BITS-1:0], norm};
  end

  // Whether the divisor goes once more into what is left in copy k.
  function fits(input [REST_BITS-1:0] rest, input [NORM_BITS-1:0] divisor);
    fits = divisor[NORM_BITS-1] & (rest >= {1'b0, divisor});
  endfunction
  function [WIDE-1:0] product_behind(input [WIDE-1:0] product, input bit_of_r, input [NORM_BITS-1:0] divisor);
    product_behind = (product << 1) + (bit_of_r ? {{(WIDE - NORM_BITS) {1'b0}}, divisor} : {WIDE{1'b0}});
  endfunction
  function [WIDE-1:0] power_of(input integer k);
    power_of = {{(WIDE - 1) {1'b0}}, 1'b1} << (NORM_BITS - 1 + k);
  endfunction
  // Whether all is right, k bits into the quotient.
  function right(input integer k, input [NORM_BITS-1:0] divisor, input [REST_BITS-1:0] rest,
                 input [WIDE-1:0] product);
    reg [WIDE-1:0] wide_rest;
    begin
      wide_rest = {{(WIDE - REST_BITS) {1'b0}}, rest};
      right = (divisor == 0) ? product == 0 :
          divisor[NORM_BITS-1] & (product <= power_of(k)) & (wide_rest == power_of(k) - (product << 1)) &
          (wide_rest < {{(WIDE - NORM_BITS - 1) {1'b0}}, divisor, 1'b0});
    end
  endfunction
  function right_end(input [NORM_BITS-1:0] divisor, input [WIDE-1:0] product);
    right_end = (divisor == 0) ? product == 0 :
        (product <= power_of(MANTISSA - 1)) &
        (power_of(MANTISSA - 1) - product < {{(WIDE - NORM_BITS) {1'b0}}, divisor});
  endfunction

  wire [WIDE-1:0] end_product = product_behind(products[(COPIES-1)*WIDE+:WIDE], mantissa[0], d[(COPIES-1)*NORM_BITS+:NORM_BITS]);
  always @* begin
    assume (is_zeros);
    assert (walks == taken);
    assert (ready == taken[MANTISSA-1]);
    if (ready) begin
      assert (right_end(d[(COPIES-1)*NORM_BITS+:NORM_BITS], end_product));
      assert (mantissa[MANTISSA-1:1] == bits[(COPIES-1)*MANTISSA+:MANTISSA-1]);
      assert (shift == z[(COPIES-1)*SHIFT_BITS+:SHIFT_BITS]);
      assert (n[(COPIES-1)*NORM_BITS+:NORM_BITS] == history[(MANTISSA-1)*NORM_BITS+:NORM_BITS]);
    end
  end

  integer k;
  generate
    if (PIPELINED != 0) begin : pipeline
      dut dut (
          .clock(clock),
          .take(take),
          .norm(norm),
          .ready(ready),
          .mantissa(mantissa),
          .shift(shift),
          .\pipeline.rests (rests),
          .\pipeline.divisors (divisors),
          .\pipeline.shifts (shifts),
          .\pipeline.quotients (quotients),
          .\pipeline.valid (walks)
      );
      always @(posedge clock)
        if (take | (|walks)) begin
          n <= {n[(MANTISSA-1)*NORM_BITS-1:0], norm};
          d <= {d[(MANTISSA-1)*NORM_BITS-1:0], aligned};
          z <= {z[(MANTISSA-1)*SHIFT_BITS-1:0], zeros};
          products[WIDE-1:0] <= 0;
          bits[MANTISSA-1:0] <= 0;
          for (k = 1; k < MANTISSA; k = k + 1) begin
            products[k*WIDE+:WIDE] <= product_behind(products[(k-1)*WIDE+:WIDE],
                fits(rests[(k-1)*REST_BITS+:REST_BITS], d[(k-1)*NORM_BITS+:NORM_BITS]), d[(k-1)*NORM_BITS+:NORM_BITS]);
            bits[k*MANTISSA+:MANTISSA] <= {bits[(k-1)*MANTISSA+:MANTISSA-1],
                fits(rests[(k-1)*REST_BITS+:REST_BITS], d[(k-1)*NORM_BITS+:NORM_BITS])};
          end
        end
      always @* begin
        assert (divisors == d);
        assert (shifts == z);
        assert (quotients == bits);
        for (k = 0; k < MANTISSA; k = k + 1) begin
          assert (!taken[k] || n[k*NORM_BITS+:NORM_BITS] == history[k*NORM_BITS+:NORM_BITS]);
          assert (!taken[k] || right(k, d[k*NORM_BITS+:NORM_BITS], rests[k*REST_BITS+:REST_BITS], products[k*WIDE+:WIDE]));
        end
      end
    end else begin : serial
      wire [MANTISSA-2:0] quotient;
      dut dut (
          .clock(clock),
          .take(take),
          .norm(norm),
          .ready(ready),
          .mantissa(mantissa),
          .shift(shift),
          .\serial.rest (rests),
          .\serial.divisor (divisors),
          .\serial.kept (shifts),
          .\serial.quotient (quotient),
          .\serial.at (walks)
      );
      assign quotients = {1'b0, quotient};
      always @(posedge clock)
        if (take) begin
          n <= norm;
          d <= aligned;
          z <= zeros;
          products <= 0;
          bits <= 0;
        end else begin
          products <= product_behind(products, fits(rests, d), d);
          bits <= {bits[MANTISSA-2:0], fits(rests, d)};
        end
      always @* begin
        // The next N comes when the last has gone.
        assume (!take || walks == 0 || ready);
        assert ((walks & (walks - 1)) == 0);
        for (k = 0; k < MANTISSA; k = k + 1)
          if (walks[k]) begin
            assert (divisors == d && shifts == z);
            assert (((quotients ^ bits) & ~({MANTISSA{1'b1}} << k)) == 0);
            assert (n == history[k*NORM_BITS+:NORM_BITS]);
            assert (right(k, d, rests, products));
          end
      end
    end
  endgenerate
endmodule
