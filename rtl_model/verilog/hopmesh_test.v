// Plays a script of bus traffic to the array and compares what it reads. A line of the script is 68 bits: what to do,
// and two words. 1 write a word (address, word); 2 a burst of writes (address, words), whose words follow in lines of
// their own; 3 a burst of reads, whose expected words follow; 4 wait for the interrupt line; 5 the next transfer is to
// be refused with this answer; 0 the end.
`timescale 1ns / 1ps
module hopmesh_test;
  `include "hopmesh_script.vh"
  localparam END = 4'd0, WRITE = 4'd1, WRITES = 4'd2, READS = 4'd3, WAIT = 4'd4, REFUSED = 4'd5;
  localparam MOST_CYCLES = 2000000000;

  reg clock = 1'b0;
  reg request = 1'b0, write = 1'b0;
  reg [31:0] address = 32'd0, bytes = 32'd0, write_data = 32'd0;
  wire ready, beat, last, read_valid, irq;
  wire [1:0] answer;
  wire [31:0] read_data;
  reg [67:0] script[0:SCRIPT_LINES-1];
  integer at = 0, wrong = 0, compared = 0, cycles = 0, taken = 0, count = 0, sent = 0;
  reg [1:0] expected_answer = 2'd0;
  reg [67:0] line;
  reg ended = 1'b0, waits = 1'b0;

  hopmesh_top array (
      .clock(clock),
      .request(request),
      .write(write),
      .address(address),
      .bytes(bytes),
      .write_data(write_data),
      .ready(ready),
      .beat(beat),
      .last(last),
      .answer(answer),
      .read_valid(read_valid),
      .read_data(read_data),
      .irq(irq)
  );

  initial $readmemh("test/script.hex", script);
  always #5 clock = ~clock;

  task compare(input [31:0] found, input [31:0] expected);
    begin
      compared = compared + 1;
      if (found !== expected) begin
        wrong = wrong + 1;
        if (wrong <= 10)
          $display("line %0d: word %0d from %h is %h, expected %h", at + 1, taken, address, found, expected);
      end
    end
  endtask

  // Looks at a cycle in its middle, and says what the array is to find at its end.
  reg moving = 1'b0, reading = 1'b0, fresh = 1'b0;
  always @(negedge clock) begin
    cycles = cycles + 1;
    if (reading && read_valid && !fresh) begin
      taken = taken + 1;
      line = script[at + taken];
      compare(read_data, line[31:0]);
    end
    fresh = 1'b0;
    if (moving) begin
      request = 1'b0;
      if (beat) begin
        sent = sent + 1;
        line = script[at + sent];
        if (script[at][67:64] == WRITES) write_data = line[31:0];
      end
      if (last) begin
        moving = 1'b0;
        if (answer !== expected_answer) begin
          wrong = wrong + 1;
          $display("line %0d: the answer to %h is %0d, expected %0d", at + 1, address, answer, expected_answer);
        end
        if (answer != 2'd0) reading = 1'b0;
        expected_answer = 2'd0;
        if (!reading) at = at + 1 + ((script[at][67:64] == WRITES) ? count : 0);
      end
    end else if (reading) begin
      if (taken == count) begin
        reading = 1'b0;
        at = at + 1 + count;
      end
    end
    if (ready && !moving && !reading && !ended) begin
      line = script[at];
      waits = 1'b0;
      case (line[67:64])
        WRITE, WRITES, READS: begin
          address = line[63:32];
          count = (line[67:64] == WRITE) ? 1 : line[31:0];
          bytes = 4 * count;
          write = line[67:64] != READS;
          request = 1'b1;
          moving = 1'b1;
          reading = !write;
          fresh = 1'b1;
          taken = 0;
          sent = 0;
          if (line[67:64] == WRITE) write_data = line[31:0];
          else if (write) begin
            line = script[at + 1];
            write_data = line[31:0];
          end
        end
        WAIT: begin
          waits = 1'b1;
          if (irq) at = at + 1;
        end
        REFUSED: begin
          expected_answer = line[1:0];
          at = at + 1;
        end
        default: ended = 1'b1;
      endcase
    end
    if (ended || cycles == MOST_CYCLES) begin
      if (!ended) $display("no end after %0d cycles", cycles);
      if (wrong != 0 || !ended) $display("FAILED: %0d of %0d words wrong", wrong, compared);
      else $display("PASSED: %0d words equal, %0d cycles", compared, cycles);
      $finish;
    end
  end
endmodule
