// A signed number in another width: sign extended, or cut where it is known to fit.
module hm_resize #(
    parameter FROM = 8,
    parameter TO = 8
) (
    // verilator lint_off UNUSED
    input  wire signed [FROM-1:0] number,
    // verilator lint_on UNUSED
    output wire signed [  TO-1:0] resized
);
  generate
    if (TO > FROM) begin : longer
      assign resized = {{(TO - FROM) {number[FROM-1]}}, number};
    end else begin : cut
      assign resized = number[TO-1:0];
    end
  endgenerate
endmodule
