// A memory with a port to write and a port to read, both by clock. Nobody reads a place in the cycle in which it is
// written, so what such a read would give does not matter.
module hm_ram #(
    parameter WIDTH = 8,
    parameter DEPTH = 16,
    parameter ADDRESS = 4
) (
    input  wire               clock,
    input  wire               write,
    input  wire [ADDRESS-1:0] write_address,
    input  wire [  WIDTH-1:0] write_data,
    input  wire               read,
    input  wire [ADDRESS-1:0] read_address,
    output reg  [  WIDTH-1:0] read_data
);
  (* no_rw_check *)
  reg [WIDTH-1:0] memory[0:DEPTH-1];
  integer k;
  initial begin
    for (k = 0; k < DEPTH; k = k + 1) memory[k] = {WIDTH{1'b0}};
    read_data = {WIDTH{1'b0}};
  end
  always @(posedge clock) begin
    if (write) memory[write_address] <= write_data;
    if (read) read_data <= memory[read_address];
  end
endmodule
