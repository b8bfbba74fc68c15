// The limiter: what lies within the bounds stays, the rest goes to the nearer bound.
module check_limit #(
    parameter FROM = 26,
    parameter UNIT = 22,
    parameter TO = 24
) (
    input wire signed [FROM-1:0] code
);
  wire signed [TO-1:0] limited;
  hm_limit #(
      .FROM(FROM),
      .UNIT(UNIT),
      .TO(TO)
  ) dut (
      .code(code),
      .limited(limited)
  );
  localparam signed [FROM-1:0] ONE = {{(FROM - 1) {1'b0}}, 1'b1} <<< UNIT;
  wire signed [FROM-1:0] shown = {{(FROM - TO) {limited[TO-1]}}, limited};
  always @* begin
    assert (-ONE <= shown && shown <= ONE);
    assert (shown == code || (code > ONE && shown == ONE) || (code < -ONE && shown == -ONE));
  end
endmodule
