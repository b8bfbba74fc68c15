// A table that depends on the network, read by clock. FILE is read by $readmemh; where it is empty, a simulator
// fills the memory.
module hm_rom #(
    parameter WIDTH = 8,
    parameter DEPTH = 16,
    parameter ADDRESS = 4,
    parameter FILE = ""
) (
    input  wire               clock,
    input  wire [ADDRESS-1:0] address,
    output reg  [  WIDTH-1:0] data
);
  reg [WIDTH-1:0] memory[0:DEPTH-1]  /* verilator public_flat_rw */;
  initial begin
    data = {WIDTH{1'b0}};
    if (FILE != "") $readmemh(FILE, memory);
  end
  always @(posedge clock) data <= memory[address];
endmodule
