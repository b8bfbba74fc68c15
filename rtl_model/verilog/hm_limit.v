// A signed code held within +-2^UNIT.
module hm_limit #(
    parameter FROM = 26,
    parameter UNIT = 22,
    parameter TO = 24
) (
    input  wire signed [FROM-1:0] code,
    output wire signed [  TO-1:0] limited
);
  localparam signed [FROM-1:0] ONE = {{(FROM - 1) {1'b0}}, 1'b1} <<< UNIT;
  wire signed [FROM-1:0] held = (code > ONE) ? ONE : (code < -ONE) ? -ONE : code;
  hm_resize #(
      .FROM(FROM),
      .TO(TO)
  ) resize (
      .number (held),
      .resized(limited)
  );
endmodule
