// Stands for a product R u (A is u, B is R) whose value does not matter: u is at most 1, so it is at most R.
module \$mul (
    A,
    B,
    Y
);
  parameter A_SIGNED = 0;
  parameter B_SIGNED = 0;
  parameter A_WIDTH = 1;
  parameter B_WIDTH = 1;
  parameter Y_WIDTH = 1;
  input [A_WIDTH-1:0] A;
  input [B_WIDTH-1:0] B;
  output [Y_WIDTH-1:0] Y;
  assign Y = $anyseq;
  wire [Y_WIDTH-1:0] most = B << `PLACES;
  wire [A_WIDTH-1:0] one = {{(A_WIDTH - 1) {1'b0}}, 1'b1} << `PLACES;
  always @* assume (A > one || Y <= most);
endmodule
