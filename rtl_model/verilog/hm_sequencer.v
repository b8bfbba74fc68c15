// Walks a run: START taken, prepare, phase after phase, the check, sweep after sweep; and inside a phase, round after
// round (docs/hardware/cycles.md). Tables say what the network is: a line for every tap that the longest row of a
// round has, and how many neurons a round has.
module hm_sequencer #(
    parameter SHARED = 1,          // one stage for all elements
    parameter STAGE_CYCLES = 4,
    parameter HAS_PREPARE = 1,
    parameter PREPARE_DEPTH = 19,  // cycles from N to where it is kept
    parameter LINE_BITS = 11,
    parameter ROUND_BITS = 7,
    parameter COUNT_BITS = 5,      // of the neurons of a round
    parameter STATE_BITS = 24,
    parameter SUM_BITS = 39,
    parameter HAS_MOMENTUM = 0,
    parameter ENTRY_BITS = 8,
    parameter TWO_BANKS = 0
) (
    input  wire                  clock,
    // From the registers: in the last cycle of the transfer that asks for it.
    input  wire                  begin_run,
    input  wire                  begin_reset,
    input  wire                  cut_short,     // with the sweep at hand
    input  wire [          31:0] reset_cycles,
    input  wire [          31:0] threshold,
    input  wire [          31:0] most_sweeps,
    input  wire                  stop_by_sum,
    input  wire [           5:0] stop_share,
    input  wire [          63:0] sum_threshold,
    // verilator lint_off UNUSED
    input  wire [ENTRY_BITS-1:0] last_entry,
    input  wire                  wrong_way,
    // verilator lint_on UNUSED
    // Of the line that is read next, and of the round at hand.
    output wire [ LINE_BITS-1:0] line_address,
    output wire [ROUND_BITS-1:0] round_address,
    input  wire                  line_ends_round,
    input  wire                  line_ends_phase,
    input  wire                  line_ends_sweep,
    input  wire [COUNT_BITS-1:0] round_count,
    input  wire                  round_ends_phase,
    input  wire                  round_ends_sweep,
    // To elements and stages.
    output reg  [ LINE_BITS-1:0] line,
    output wire                  read,
    output wire                  add,
    output wire                  norms,
    output wire                  leave,
    output wire                  take,          // sums go into the stage: of `slot`, or of all
    output reg                   take_norm,     // they are norms
    output reg  [COUNT_BITS-1:0] slot,
    output reg  [COUNT_BITS-1:0] slots,         // of the round that goes into a stage
    output wire                  begin_sweep,
    output reg                   by_sum,
    output reg                   bank,          // that is read
    output reg                   show_state,    // Y is V
    output reg  [ENTRY_BITS-1:0] entry,         // of the table of m
    output wire                  clearing,
    output reg  [          31:0] clear_address,
    // What came of it.
    input  wire [  STATE_BITS:0] largest_change,
    input  wire [  SUM_BITS-2:0] largest_sum,
    output wire                  done,          // in the last cycle of a run
    output wire                  cleared,       // in the last cycle of a RESET behind which no run begins
    output wire                  running,
    output wire                  converged,
    output reg                   aborted,
    output wire [          31:0] sweeps,
    output wire [          63:0] cycles
);
  localparam IDLE = 3'd0, CLEAR = 3'd1, START = 3'd2, PREPARE = 3'd3, PHASE = 3'd4, CHECK = 3'd5;
  localparam LONGEST = ((PREPARE_DEPTH > STAGE_CYCLES) ? PREPARE_DEPTH : STAGE_CYCLES);
  localparam LEFT_BITS = COUNT_BITS + $clog2(LONGEST + 1) + 1;
  localparam [31:0] OUT_OF_STAGE = STAGE_CYCLES;
  localparam [31:0] OUT_OF_PREPARE = PREPARE_DEPTH;

  reg [2:0] at;
  reg run_behind;  // a run begins when the memories are empty
  reg [31:0] kept_threshold, kept_most, swept;
  reg [63:0] kept_floor, passed, first_sum;
  reg [5:0] kept_share;

  wire phase = at == PHASE;
  wire works = phase | norms;
  assign norms = at == PREPARE;
  assign clearing = at == CLEAR;
  assign running = (at != IDLE) & (at != CLEAR);

  // ---- taps: a line is read, then added
  reg more;          // there are lines to read in this segment
  reg full;          // the sum is whole, and waits
  reg standing;      // a line was read and is not added yet
  reg standing_last; // of its round
  wire ends_segment = phase ? line_ends_phase : line_ends_sweep;
  assign add  = works & standing & ~full;
  assign read = works & more & (~standing | add);
  wire [LINE_BITS-1:0] following = line_ends_sweep ? {LINE_BITS{1'b0}} : line + {{(LINE_BITS - 1) {1'b0}}, 1'b1};
  assign line_address = read ? following : line;

  // ---- rounds: sums leave, and go into a stage
  reg [ROUND_BITS-1:0] round;
  reg [LEFT_BITS-1:0] occupied;  // cycles until the next sums may leave, while not 0
  reg [LEFT_BITS-1:0] left;      // cycles until the segment ends, while not 0
  reg ends_sweep;
  wire whole = (add & standing_last) | full;
  wire is_free = occupied <= {{(LEFT_BITS - 1) {1'b0}}, 1'b1};
  assign leave = works & whole & is_free;
  wire last_round = phase ? round_ends_phase : round_ends_sweep;
  wire [ROUND_BITS-1:0] next_round = round_ends_sweep ? {ROUND_BITS{1'b0}} : round + {{(ROUND_BITS - 1) {1'b0}}, 1'b1};
  assign round_address = leave ? next_round : round;
  wire [LEFT_BITS-1:0] depth = phase ? OUT_OF_STAGE[LEFT_BITS-1:0] : OUT_OF_PREPARE[LEFT_BITS-1:0];
  wire [LEFT_BITS-1:0] wide_count = {{(LEFT_BITS - COUNT_BITS) {1'b0}}, round_count};
  wire [LEFT_BITS-1:0] one_by_one = (SHARED != 0) ? wide_count - {{(LEFT_BITS - 1) {1'b0}}, 1'b1} : {LEFT_BITS{1'b0}};
  wire [LEFT_BITS-1:0] rest = depth + one_by_one;
  wire ends = (leave & last_round & (rest == {LEFT_BITS{1'b0}})) | (left == {{(LEFT_BITS - 1) {1'b0}}, 1'b1});

  reg taking;
  assign take = taking;
  wire last_slot = slot + {{(COUNT_BITS - 1) {1'b0}}, 1'b1} == slots;

  // ---- the check
  // verilator lint_off UNUSED
  wire [63:0] wide_sum = {{(65 - SUM_BITS) {1'b0}}, largest_sum};
  // verilator lint_on UNUSED
  wire [63:0] first = (swept == 32'd0) ? wide_sum : first_sum;
  wire [63:0] share = (kept_share == 6'd0) ? 64'd0 : first >> kept_share;
  wire [63:0] wide_change = {{(63 - STATE_BITS) {1'b0}}, largest_change};
  wire by_rule = by_sum ? ((wide_sum <= kept_floor) | (wide_sum <= share)) : (wide_change <= {32'd0, kept_threshold});
  wire check = at == CHECK;
  assign sweeps = swept + 32'd1;
  assign cycles = passed + 64'd1;
  assign converged = by_rule;
  assign done = check & (by_rule | aborted | cut_short | (sweeps == kept_most));
  assign cleared = clearing & (clear_address + 32'd1 == reset_cycles) & ~run_behind;
  assign begin_sweep = ((at == START) & (HAS_PREPARE == 0)) | (norms & ends) | (check & ~done);
  wire begin_segment = (at == START) | (works & ends) | check;

  initial begin
    at = IDLE;
    run_behind = 1'b0;
    {kept_threshold, kept_most, swept} = 96'd0;
    {kept_floor, passed, first_sum} = 192'd0;
    kept_share = 6'd0;
    {more, full, standing, standing_last, ends_sweep, taking, take_norm} = 7'd0;
    line = {LINE_BITS{1'b0}};
    round = {ROUND_BITS{1'b0}};
    {occupied, left} = {(2 * LEFT_BITS) {1'b0}};
    {slot, slots} = {(2 * COUNT_BITS) {1'b0}};
    {by_sum, bank, show_state, aborted} = 4'd0;
    entry = {ENTRY_BITS{1'b0}};
    clear_address = 32'd0;
  end

  always @(posedge clock) begin
    case (at)
      IDLE: if (begin_reset) at <= CLEAR; else if (begin_run) at <= START;
      CLEAR: if (clear_address + 32'd1 == reset_cycles) at <= run_behind ? START : IDLE;
      START: at <= (HAS_PREPARE != 0) ? PREPARE : PHASE;
      PREPARE: if (ends) at <= PHASE;
      PHASE: if (ends) at <= ends_sweep | (leave & round_ends_sweep) ? CHECK : PHASE;
      default: at <= done ? IDLE : PHASE;
    endcase
    if ((at == IDLE) & (begin_reset | begin_run)) begin
      run_behind <= begin_run;
      clear_address <= 32'd0;
      kept_threshold <= threshold;
      kept_most <= (most_sweeps == 32'd0) ? 32'd1 : most_sweeps;
      kept_floor <= sum_threshold;
      kept_share <= stop_share;
      by_sum <= stop_by_sum;
      swept <= 32'd0;
      passed <= 64'd0;
      aborted <= 1'b0;
    end
    if (clearing) clear_address <= clear_address + 32'd1;
    if (running) passed <= cycles;
    if (running & cut_short) aborted <= 1'b1;
    if (check) begin
      swept <= sweeps;
      first_sum <= first;
    end
  end

  always @(posedge clock) begin
    if (read) begin
      line <= following;
      standing_last <= line_ends_round;
    end
    if (begin_segment) begin
      more <= 1'b1;
      standing <= 1'b0;
      full <= 1'b0;
      occupied <= {LEFT_BITS{1'b0}};
      left <= {LEFT_BITS{1'b0}};
      ends_sweep <= 1'b0;
    end else if (works) begin
      if (read & ends_segment) more <= 1'b0;
      standing <= read | (standing & ~add);
      full <= whole & ~leave;
      if (leave) begin
        occupied <= (SHARED != 0) ? wide_count : depth;
        ends_sweep <= round_ends_sweep;
      end else if (occupied != {LEFT_BITS{1'b0}}) occupied <= occupied - {{(LEFT_BITS - 1) {1'b0}}, 1'b1};
      if (leave & last_round) left <= rest;
      else if (left != {LEFT_BITS{1'b0}}) left <= left - {{(LEFT_BITS - 1) {1'b0}}, 1'b1};
    end
    if (leave) begin
      round <= next_round;
      slots <= round_count;
      take_norm <= norms;
      slot <= {COUNT_BITS{1'b0}};
      taking <= 1'b1;
    end else if (taking) begin
      if ((SHARED == 0) | last_slot) taking <= 1'b0;
      else slot <= slot + {{(COUNT_BITS - 1) {1'b0}}, 1'b1};
    end
    if ((TWO_BANKS != 0) & phase & ends) bank <= ~bank;
  end

  generate
    if (HAS_MOMENTUM != 0) begin : table_of_m
      wire [ENTRY_BITS-1:0] taken = wrong_way ? {ENTRY_BITS{1'b0}} : entry;
      always @(posedge clock) begin
        if (at == START) entry <= {ENTRY_BITS{1'b0}};
        else if (check) entry <= (taken == last_entry) ? last_entry : taken + {{(ENTRY_BITS - 1) {1'b0}}, 1'b1};
        if ((at == START) | check) show_state <= (at == START) | wrong_way;
      end
    end else begin : no_table
      always @(posedge clock) begin
        entry <= {ENTRY_BITS{1'b0}};
        show_state <= 1'b1;
      end
    end
  endgenerate
endmodule
