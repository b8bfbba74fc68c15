// Access rights of the register file, as docs/hardware/registers.md tells them in words: which addresses exist, which
// may be written, that the limits of a run are read back and change by nothing else but a RESET, and that what is written
// only reads as 0. Causes of interrupts are not looked at.
module check_registers #(
    parameter STATE_BITS = 8,
    parameter SUM_BITS = 12
) (
    input wire         clock,
    input wire         access,
    input wire         write,
    input wire [ 11:0] offset,
    input wire [ 31:0] data,
    input wire         done,
    input wire         cleared,
    input wire         clearing,
    input wire         converged,
    input wire         aborted,
    input wire [ 31:0] sweeps,
    input wire [ 63:0] cycles,
    input wire [STATE_BITS:0] largest_change,
    input wire [SUM_BITS-2:0] largest_sum
);
  wire exists, writable, irq, busy, begin_run, begin_reset, cut_short, stop_by_sum;
  wire [31:0] read_word, threshold, most_sweeps;
  wire [5:0] stop_share;
  wire [63:0] sum_threshold;
  hm_registers #(
      .STATE_BITS(STATE_BITS),
      .SUM_BITS(SUM_BITS),
      .CAPABILITIES(30)
  ) dut (
      .clock(clock),
      .access(access),
      .write(write),
      .offset(offset),
      .data(data),
      .capabilities(960'd0),
      .exists(exists),
      .writable(writable),
      .read_word(read_word),
      .irq(irq),
      .busy(busy),
      .hold(access),
      .hold_cycles(32'd2),
      .begin_run(begin_run),
      .begin_reset(begin_reset),
      .cut_short(cut_short),
      .threshold(threshold),
      .most_sweeps(most_sweeps),
      .stop_by_sum(stop_by_sum),
      .stop_share(stop_share),
      .sum_threshold(sum_threshold),
      .done(done),
      .cleared(cleared),
      .clearing(clearing),
      .converged(converged),
      .aborted(aborted),
      .sweeps(sweeps),
      .cycles(cycles),
      .largest_change(largest_change),
      .largest_sum(largest_sum)
  );
  wire is_writable = offset == 12'h080 || offset == 12'h088 || offset == 12'h08C || offset == 12'h090 ||
      offset == 12'h094 || offset == 12'h0B0 || offset == 12'h0BC || offset == 12'h0C0 || offset == 12'h0C4;
  wire resets = access & write & (offset == 12'h080) & data[1] & ~busy;

  // What was there a cycle ago.
  reg is_old = 0, was_write, was_read, was_reset;
  reg [11:0] was_offset;
  reg [31:0] was_data, was_threshold, was_most;
  reg [63:0] was_floor;
  reg [6:0] was_stop;
  always @(posedge clock) begin
    is_old <= 1;
    was_write <= access & write;
    was_read <= access & ~write;
    was_reset <= resets;
    was_offset <= offset;
    was_data <= data;
    was_threshold <= threshold;
    was_most <= most_sweeps;
    was_floor <= sum_threshold;
    was_stop <= {stop_share, stop_by_sum};
  end
  always @* begin
    assume (offset[1:0] == 0);
    assume (!access || (exists && (!write || writable)));
    assert (exists == (offset <= 12'h0C4));
    assert (!exists || writable == is_writable);
    if (is_old) begin
      assert (threshold == (was_reset ? 0 : (was_write && was_offset == 12'h090) ? was_data : was_threshold));
      assert (most_sweeps == (was_reset ? 1 : (was_write && was_offset == 12'h094) ? was_data : was_most));
      assert (sum_threshold[31:0] == (was_reset ? 0 : (was_write && was_offset == 12'h0BC) ? was_data : was_floor[31:0]));
      assert (sum_threshold[63:32] == (was_reset ? 0 : (was_write && was_offset == 12'h0C0) ? was_data : was_floor[63:32]));
      assert ({stop_share, stop_by_sum} == (was_reset ? 0 : (was_write && was_offset == 12'h0C4) ? {was_data[13:8], was_data[0]} :
          was_stop));
      if (was_read && was_offset == 12'h090) assert (read_word == was_threshold);
      if (was_read && was_offset == 12'h094) assert (read_word == was_most);
      if (was_read && (was_offset == 12'h080 || was_offset == 12'h0B0)) assert (read_word == 0);
      assert (!begin_run || was_write && was_offset == 12'h080 && was_data[0]);
      assert (begin_reset == was_reset);
    end
  end
endmodule
