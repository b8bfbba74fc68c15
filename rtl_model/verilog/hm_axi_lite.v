// AXI4-Lite in front of the native bus: a word a transfer, writes before reads. A transfer that the device refuses is
// answered by DECERR where no such address is, else by SLVERR; so is a write that leaves out bytes, which the device
// never sees. Nothing is lost: an address waits until its turn comes.
module hm_axi_lite (
    input  wire        clock,
    input  wire        reset_n,      // of the wrapper; the device has its RESET in CONTROL
    input  wire        awvalid,
    output wire        awready,
    input  wire [31:0] awaddr,
    input  wire        wvalid,
    output wire        wready,
    input  wire [31:0] wdata,
    input  wire [ 3:0] wstrb,
    output wire        bvalid,
    input  wire        bready,
    output wire [ 1:0] bresp,
    input  wire        arvalid,
    output wire        arready,
    input  wire [31:0] araddr,
    output wire        rvalid,
    input  wire        rready,
    output wire [31:0] rdata,
    output wire [ 1:0] rresp,
    // The native bus.
    output wire        request,
    output wire        write,
    output wire [31:0] address,
    output wire [31:0] bytes,
    output wire [31:0] write_data,
    input  wire        ready,
    input  wire        last,
    input  wire [ 1:0] answer,
    input  wire        read_valid,
    input  wire [31:0] read_data
);
  localparam IDLE = 2'd0, MOVES = 2'd1, READS = 2'd2, ANSWERS = 2'd3;
  localparam [1:0] OKAY = 2'b00, SLVERR = 2'b10, DECERR = 2'b11;
  localparam [1:0] DONE = 2'd0, NO_ADDRESS = 2'd1;

  reg [1:0] at = IDLE;
  reg writing = 1'b0;
  reg [1:0] response = OKAY;
  reg [31:0] word = 32'd0, kept = 32'd0;

  wire takes_write = (at == IDLE) & ready & awvalid & wvalid;
  wire takes_read = (at == IDLE) & ready & arvalid & ~takes_write;
  wire whole = wstrb == 4'b1111;
  assign awready = takes_write;
  assign wready  = takes_write;
  assign arready = takes_read;
  assign request = (takes_write & whole) | takes_read;
  assign write   = takes_write;
  assign address = takes_write ? awaddr : araddr;
  assign bytes   = 32'd4;
  assign write_data = (at == IDLE) ? wdata : kept;
  assign bvalid = (at == ANSWERS) & writing;
  assign rvalid = (at == ANSWERS) & ~writing;
  assign bresp  = response;
  assign rresp  = response;
  assign rdata  = word;

  always @(posedge clock) begin
    if (!reset_n) at <= IDLE;
    else
      case (at)
        IDLE: if (takes_write | takes_read) at <= (takes_write & ~whole) ? ANSWERS : MOVES;
        MOVES: if (last) at <= (writing | (answer != DONE)) ? ANSWERS : READS;
        READS: if (read_valid) at <= ANSWERS;
        default: if (writing ? bready : rready) at <= IDLE;
      endcase
    if (takes_write | takes_read) begin
      writing <= takes_write;
      kept <= wdata;
      response <= SLVERR;
    end
    if ((at == MOVES) & last) response <= (answer == DONE) ? OKAY : (answer == NO_ADDRESS) ? DECERR : SLVERR;
    if (at == READS) word <= read_data;
  end
endmodule
