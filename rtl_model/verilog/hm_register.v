// COUNT registers one behind the other: a signal some cycles later. COUNT = 0 is a wire.
module hm_register #(
    parameter WIDTH = 1,
    parameter COUNT = 1
) (
    // verilator lint_off UNUSED
    input  wire             clock,
    // verilator lint_on UNUSED
    input  wire [WIDTH-1:0] now,
    output wire [WIDTH-1:0] later
);
  generate
    if (COUNT == 0) begin : none
      assign later = now;
    end else if (COUNT == 1) begin : one
      reg [WIDTH-1:0] kept = {WIDTH{1'b0}};
      always @(posedge clock) kept <= now;
      assign later = kept;
    end else begin : chain
      reg [COUNT*WIDTH-1:0] kept = {(COUNT * WIDTH) {1'b0}};
      always @(posedge clock) kept <= {kept[(COUNT-1)*WIDTH-1:0], now};
      assign later = kept[COUNT*WIDTH-1:(COUNT-1)*WIDTH];
    end
  endgenerate
endmodule
