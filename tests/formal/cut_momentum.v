// Stands for a product m change (B is the change, signed) whose value does not matter: |m| is at most 1, so it is at
// most |change|.
module \$mul (
    A,
    B,
    Y
);
  parameter A_SIGNED = 1;
  parameter B_SIGNED = 1;
  parameter A_WIDTH = 1;
  parameter B_WIDTH = 1;
  parameter Y_WIDTH = 1;
  input [A_WIDTH-1:0] A;
  input signed [B_WIDTH-1:0] B;
  output signed [Y_WIDTH-1:0] Y;
  assign Y = $anyseq;
  wire signed [Y_WIDTH-1:0] wide = {{(Y_WIDTH - B_WIDTH) {B[B_WIDTH-1]}}, B};
  wire signed [Y_WIDTH-1:0] most = (wide < 0 ? -wide : wide) <<< 15;
  always @* assume (-most <= Y && Y <= most);
endmodule
