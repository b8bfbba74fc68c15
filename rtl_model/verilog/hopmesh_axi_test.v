// Asks the array through AXI4-Lite: registers, a word of each window that can be written, and every way to be refused.
`timescale 1ns / 1ps
module hopmesh_axi_test;
  `include "hm_register_map.vh"
  localparam [1:0] OKAY = 2'b00, SLVERR = 2'b10, DECERR = 2'b11;
  reg clock = 1'b0, reset_n = 1'b0;
  reg awvalid = 1'b0, wvalid = 1'b0, bready = 1'b0, arvalid = 1'b0, rready = 1'b0;
  reg [31:0] awaddr = 32'd0, wdata = 32'd0, araddr = 32'd0, word = 32'd0, window = 32'd0;
  reg [3:0] wstrb = 4'b1111;
  wire awready, wready, bvalid, arready, rvalid, irq;
  wire [1:0] bresp, rresp;
  wire [31:0] rdata;
  integer wrong = 0, asked = 0;

  hopmesh_axi_top array (
      .clock(clock),
      .reset_n(reset_n),
      .awvalid(awvalid),
      .awready(awready),
      .awaddr(awaddr),
      .wvalid(wvalid),
      .wready(wready),
      .wdata(wdata),
      .wstrb(wstrb),
      .bvalid(bvalid),
      .bready(bready),
      .bresp(bresp),
      .arvalid(arvalid),
      .arready(arready),
      .araddr(araddr),
      .rvalid(rvalid),
      .rready(rready),
      .rdata(rdata),
      .rresp(rresp),
      .irq(irq)
  );
  always #5 clock = ~clock;

  task expect_response(input [1:0] found, input [1:0] expected, input [31:0] at);
    begin
      asked = asked + 1;
      if (found !== expected) begin
        wrong = wrong + 1;
        $display("the response to %h is %b, expected %b", at, found, expected);
      end
    end
  endtask

  // Signals change at the falling edge; the array sees them at the rising one.
  task put(input [31:0] at, input [31:0] data, input [3:0] strobes, input [1:0] expected);
    begin
      @(negedge clock);
      awaddr  = at;
      wdata   = data;
      wstrb   = strobes;
      awvalid = 1'b1;
      wvalid  = 1'b1;
      #1;
      while (!(awready && wready)) begin
        @(negedge clock);
        #1;
      end
      @(negedge clock);
      awvalid = 1'b0;
      wvalid  = 1'b0;
      while (!bvalid) @(negedge clock);
      expect_response(bresp, expected, at);
      bready = 1'b1;
      @(negedge clock);
      bready = 1'b0;
    end
  endtask

  task get(input [31:0] at, input [1:0] expected);
    begin
      @(negedge clock);
      araddr  = at;
      arvalid = 1'b1;
      #1;
      while (!arready) begin
        @(negedge clock);
        #1;
      end
      @(negedge clock);
      arvalid = 1'b0;
      while (!rvalid) @(negedge clock);
      word = rdata;
      expect_response(rresp, expected, at);
      rready = 1'b1;
      @(negedge clock);
      rready = 1'b0;
    end
  endtask

  task expect_word(input [31:0] at, input [31:0] expected);
    begin
      get(at, OKAY);
      if (word !== expected) begin
        wrong = wrong + 1;
        $display("%h is %h, expected %h", at, word, expected);
      end
    end
  endtask

  // A word of a window: there, kept, and refused while a run is at work.
  task try_window(input [31:0] register);
    begin
      get(register, OKAY);
      window = word;
      put(window, 32'd5, 4'b1111, OKAY);
      expect_word(window, 32'd5);
    end
  endtask

  initial begin
    repeat (3) @(negedge clock);
    reset_n = 1'b1;
    expect_word(HM_REG_ID, HM_RESET_ID);
    expect_word(HM_REG_VERSION, HM_RESET_VERSION);
    put(HM_REG_THRESHOLD, 32'h12345678, 4'b1111, OKAY);
    expect_word(HM_REG_THRESHOLD, 32'h12345678);
    put(HM_REG_THRESHOLD, 32'd0, 4'b0011, SLVERR);
    expect_word(HM_REG_THRESHOLD, 32'h12345678);
    put(HM_REG_ID, 32'd0, 4'b1111, SLVERR);
    put(32'hfffffffc, 32'd0, 4'b1111, DECERR);
    get(32'hfffffffc, DECERR);
    get(HM_REG_ID + 32'd2, DECERR);
    try_window(HM_REG_CAP_WINDOW_BIAS);
    try_window(HM_REG_CAP_WINDOW_OUTPUT);
    try_window(HM_REG_CAP_WINDOW_WEIGHT);
    get(HM_REG_CAP_WINDOW_LINK, OKAY);
    put(word, 32'd1, 4'b1111, SLVERR);
    put(HM_REG_IRQ_ENABLE, 32'd1, 4'b1111, OKAY);
    put(HM_REG_MAX_SWEEPS, 32'd3, 4'b1111, OKAY);
    put(HM_REG_CONTROL, 32'd1, 4'b1111, OKAY);
    get(window, SLVERR);
    put(window, 32'd1, 4'b1111, SLVERR);
    while (!irq) @(negedge clock);
    get(HM_REG_SWEEPS, OKAY);
    if (word == 32'd0) wrong = wrong + 1;
    expect_word(window, 32'd5);
    if (wrong != 0) $display("FAILED: %0d of %0d wrong", wrong, asked);
    else $display("PASSED: %0d transfers", asked);
    $finish;
  end
endmodule
