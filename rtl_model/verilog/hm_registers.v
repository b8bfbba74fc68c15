// The register file (docs/hardware/registers.md). A transfer reads and changes registers in its first cycle, `access`;
// a run or a RESET that it asks for begins behind its last cycle, which is the one after. Addresses, and who may
// write, come from the one table of registers.
module hm_registers #(
    parameter STATE_BITS = 24,
    parameter SUM_BITS = 39,
    parameter CAPABILITIES = 30
) (
    input  wire                       clock,
    input  wire                       access,
    input  wire                       write,
    // verilator lint_off UNUSED
    input  wire [               11:0] offset,
    // verilator lint_on UNUSED
    input  wire [               31:0] data,
    input  wire [CAPABILITIES*32-1:0] capabilities,
    output wire                       exists,      // at `offset`
    output wire                       writable,
    output wire [               31:0] read_word,   // in the cycle after `access`
    output wire                       irq,
    output wire                       busy,
    // Of every transfer, in its first cycle: how many cycles it holds the bus.
    input  wire                       hold,
    input  wire [               31:0] hold_cycles,
    // The array.
    output wire                       begin_run,
    output wire                       begin_reset,
    output wire                       cut_short,
    output reg  [               31:0] threshold,
    output reg  [               31:0] most_sweeps,
    output reg                        stop_by_sum,
    output reg  [                5:0] stop_share,
    output reg  [               63:0] sum_threshold,
    input  wire                       done,
    input  wire                       cleared,
    input  wire                       clearing,
    input  wire                       converged,
    input  wire                       aborted,
    input  wire [               31:0] sweeps,
    input  wire [               63:0] cycles,
    input  wire [       STATE_BITS:0] largest_change,
    input  wire [       SUM_BITS-2:0] largest_sum
);
  `include "hm_register_map.vh"

  wire [5:0] number = offset[7:2];
  wire low = offset[11:8] == 4'd0;
  assign exists = low & HM_REGISTERS[number];
  assign writable = HM_WRITABLE[number];
  wire [31:0] at = {20'd0, offset};
  wire writes = access & write;
  wire reads = access & ~write;

  // STATUS, causes and what is kept of the last run.
  reg is_busy, is_done, is_converged, is_aborted;
  reg [1:0] causes, enabled;
  reg [31:0] kept_sweeps, kept_change;
  reg [63:0] kept_cycles, kept_sum, held;
  reg [31:0] cycles_high, held_high, sum_high;
  reg starts, resets;
  reg is_held_low;
  reg [31:0] word;

  // ---- CONTROL: an ABORT is for what is at work before this word
  wire control = writes & (at == HM_REG_CONTROL);
  wire asks_start = control & data[HM_CONTROL_START];
  wire asks_reset = control & data[HM_CONTROL_RESET];
  wire asks_abort = control & data[HM_CONTROL_ABORT] & is_busy;
  wire refused = is_busy & (asks_start | asks_reset | (asks_abort & clearing));
  assign cut_short = asks_abort & ~clearing;
  assign begin_run = starts;
  assign begin_reset = resets;
  assign busy = is_busy;
  wire accepted_reset = asks_reset & ~is_busy;

  wire [1:0] tested = (writes & (at == HM_REG_IRQ_TEST)) ? data[1:0] : 2'd0;
  wire [1:0] left = (writes & (at == HM_REG_IRQ_STATUS)) ? causes & ~data[1:0] : causes;
  wire [1:0] raised = {refused, done};
  assign irq = |(causes & enabled);

  // verilator lint_off UNUSED
  wire [STATE_BITS+32:0] wide_change = {32'd0, largest_change};
  // verilator lint_on UNUSED

  initial begin
    {is_busy, is_done, is_converged, is_aborted, starts, resets, is_held_low} = 7'd0;
    {causes, enabled} = 4'd0;
    {kept_sweeps, kept_change, cycles_high, held_high, sum_high, word} = 192'd0;
    {kept_cycles, kept_sum, held, sum_threshold} = 256'd0;
    threshold = 32'd0;
    most_sweeps = HM_RESET_MAX_SWEEPS;
    {stop_by_sum, stop_share} = 7'd0;
  end

  always @(posedge clock) begin
    starts <= asks_start & ~is_busy;
    resets <= accepted_reset;
    causes <= left | tested | raised;
    if (hold) held <= held + {32'd0, hold_cycles};
    if (asks_start & ~is_busy) {is_busy, is_done, is_converged, is_aborted} <= 4'b1000;
    if (cleared) is_busy <= 1'b0;
    if (done) begin
      {is_busy, is_done, is_converged, is_aborted} <= {1'b0, 1'b1, converged, aborted | cut_short};
      kept_sweeps <= sweeps;
      kept_cycles <= cycles;
      kept_change <= wide_change[31:0];
      kept_sum <= {{(65 - SUM_BITS) {1'b0}}, largest_sum};
    end
    if (writes) begin
      case (at)
        HM_REG_IRQ_ENABLE: enabled <= data[1:0];
        HM_REG_THRESHOLD: threshold <= data;
        HM_REG_MAX_SWEEPS: most_sweeps <= data;
        HM_REG_SUM_THRESHOLD_LO: sum_threshold[31:0] <= data;
        HM_REG_SUM_THRESHOLD_HI: sum_threshold[63:32] <= data;
        HM_REG_STOP: {stop_share, stop_by_sum} <= {data[HM_STOP_SHARE+:6], data[HM_STOP_BY_SUM]};
        default: ;
      endcase
    end
    if (reads) begin
      if (at == HM_REG_CYCLES_LO) cycles_high <= kept_cycles[63:32];
      if (at == HM_REG_LARGEST_SUM_LO) sum_high <= kept_sum[63:32];
    end
    if (is_held_low) held_high <= held[63:32];
    if (accepted_reset) begin
      {is_busy, is_done, is_converged, is_aborted} <= 4'b1000;
      {causes, enabled} <= 4'd0;
      {kept_sweeps, kept_change, cycles_high, held_high, sum_high} <= 160'd0;
      {kept_cycles, kept_sum, held, sum_threshold} <= 256'd0;
      threshold <= 32'd0;
      most_sweeps <= HM_RESET_MAX_SWEEPS;
      {stop_by_sum, stop_share} <= 7'd0;
    end
  end

  // ---- what is read. The bus's own counter is read a cycle late: with the cycles of this transfer.
  assign read_word = is_held_low ? held[31:0] : word;
  always @(posedge clock) begin
    is_held_low <= reads & (at == HM_REG_BUS_CYCLES_LO);
    if (reads) begin
      case (at)
        HM_REG_ID: word <= HM_RESET_ID;
        HM_REG_VERSION: word <= HM_RESET_VERSION;
        HM_REG_STATUS: word <= {28'd0, is_aborted, is_converged, is_done, is_busy};
        HM_REG_IRQ_ENABLE: word <= {30'd0, enabled};
        HM_REG_IRQ_STATUS: word <= {30'd0, causes};
        HM_REG_THRESHOLD: word <= threshold;
        HM_REG_MAX_SWEEPS: word <= most_sweeps;
        HM_REG_SWEEPS: word <= kept_sweeps;
        HM_REG_LARGEST_CHANGE: word <= kept_change;
        HM_REG_CYCLES_LO: word <= kept_cycles[31:0];
        HM_REG_CYCLES_HI: word <= cycles_high;
        HM_REG_BUS_CYCLES_HI: word <= held_high;
        HM_REG_LARGEST_SUM_LO: word <= kept_sum[31:0];
        HM_REG_LARGEST_SUM_HI: word <= sum_high;
        HM_REG_SUM_THRESHOLD_LO: word <= sum_threshold[31:0];
        HM_REG_SUM_THRESHOLD_HI: word <= sum_threshold[63:32];
        HM_REG_STOP: word <= ({26'd0, stop_share} << HM_STOP_SHARE) | ({31'd0, stop_by_sum} << HM_STOP_BY_SUM);
        default: word <= capability;
      endcase
    end
  end
  // Capabilities stand one behind the other.
  localparam [31:0] ALL = CAPABILITIES;
  wire [5:0] which = number - HM_FIRST_CAPABILITY[5:0];
  wire [31:0] capability = (which < ALL[5:0]) ? capabilities[which*32+:32] : 32'd0;
endmodule
