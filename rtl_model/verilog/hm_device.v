// The array as a host sees it: registers and windows on the native bus, and an interrupt line.
//
// The bus. `request` begins a transfer while `ready`: it carries command, address, length, and of a write the first
// word. So many words take so many cycles behind that one, the beats. A write's word k stands at `write_data` in beat
// k, where `beat` is 1. A read's word stands at `read_data` in the cycle behind its beat, where `read_valid` is 1.
// `last` is 1 in the last cycle of the transfer, where `answer` counts: 0 done; else refused, and nothing changed:
// 1 no such address, 2 no such length, 3 no such command there, or not now. A refused transfer has one beat.
//
// FACTS tell the network: 30 capability registers, the words and the sizes in bytes less 1 of the six windows, cycles
// of a RESET, the last place of a stage, the last entry of the table of m.
module hm_device #(
    parameter ELEMENTS = 16,
    parameter SHARED = 1,
    parameter OUTPUT = 0,
    parameter NORMALISER = 1,
    parameter PIPELINE = 0,
    parameter SYNCHRONOUS = 0,
    parameter WEIGHT_BITS = 16,
    parameter WEIGHT_FRACTION = 15,
    parameter BIAS_BITS = 24,
    parameter BIAS_FRACTION = 15,
    parameter SUM_BITS = 39,
    parameter SUM_FRACTION = 29,
    parameter DRIVE_BITS = 18,
    parameter DRIVE_FRACTION = 16,
    parameter DRIVE_MODE = 0,
    parameter DRIVE_OVERFLOW = 0,
    parameter STATE_BITS = 24,
    parameter STATE_FRACTION = 22,
    parameter STATE_MODE = 0,
    parameter LINK_BITS = 16,
    parameter LINK_FRACTION = 14,
    parameter LINK_MODE = 0,
    parameter MANTISSA = 18,
    parameter RELAXATION = 29,
    parameter ENTRIES = 256,
    parameter LINES = 2048,
    parameter ROUNDS = 128,
    parameter PLACES = 1140,
    parameter NEURONS = 1140,
    parameter WEIGHTS = 28710,
    parameter CELLS = 380,
    parameter LINKS = 2810,
    parameter LINES_FILE = "",
    parameter ROUNDS_FILE = "",
    parameter WEIGHT_MAP_FILE = "",
    parameter NEURON_MAP_FILE = "",
    parameter FIRST_LINK_FILE = "",
    parameter LINK_FILE = "",
    parameter FACTS = 45
) (
    input  wire                clock,
    input  wire [FACTS*32-1:0] facts,
    input  wire                request,
    input  wire                write,
    input  wire [        31:0] address,
    input  wire [        31:0] bytes,
    input  wire [        31:0] write_data,
    output wire                ready,
    output wire                beat,
    output wire                last,
    output wire [         1:0] answer,
    output reg                 read_valid,
    output wire [        31:0] read_data,
    output wire                irq,
    output wire                busy         // as STATUS tells
);
  localparam CAPABILITIES = 30, WINDOWS = 6;
  localparam DONE = 2'd0, NO_ADDRESS = 2'd1, NO_LENGTH = 2'd2, NO_COMMAND = 2'd3;
  localparam FIRST_LINK = 0, LINK = 1, BIAS = 2, STATE = 3, WEIGHT = 4, MOMENTUM = 5;
  localparam AT_WINDOWS = 23;  // among the capabilities: where windows begin
  localparam LINE_BITS = (LINES > 1) ? $clog2(LINES) : 1;
  localparam PLACE_BITS = (PLACES > 1) ? $clog2(PLACES) : 1;
  localparam ELEMENT_BITS = (ELEMENTS > 1) ? $clog2(ELEMENTS) : 1;
  localparam ENTRY_BITS = (ENTRIES > 1) ? $clog2(ENTRIES) : 1;
  localparam NEURON_BITS = (NEURONS > 1) ? $clog2(NEURONS) : 1;
  localparam WEIGHT_INDEX = (WEIGHTS > 1) ? $clog2(WEIGHTS) : 1;
  localparam CELL_BITS = $clog2(CELLS + 1);
  localparam LINK_INDEX = (LINKS > 1) ? $clog2(LINKS) : 1;
  localparam FIRST_BITS = $clog2(LINKS + 1);

  // ---- the first cycle: where does it lead, and may it?
  wire [WINDOWS-1:0] hits;
  wire [WINDOWS*32-1:0] indices;
  genvar k;
  generate
    for (k = 0; k < WINDOWS; k = k + 1) begin : windows
      wire [31:0] begins = facts[(AT_WINDOWS+k)*32+:32];
      wire [31:0] words = facts[(CAPABILITIES+k)*32+:32];
      wire [31:0] span = facts[(CAPABILITIES+WINDOWS+k)*32+:32];
      wire [31:0] place = (address & span) >> 2;
      assign indices[k*32+:32] = place;
      assign hits[k] = (words != 32'd0) & ((address & ~span) == begins) & (place < words);
    end
  endgenerate
  // At most one of them is hit.
  function [31:0] of_hit(input [WINDOWS-1:0] hit, input [WINDOWS*32-1:0] all);
    integer n;
    begin
      of_hit = 32'd0;
      for (n = 0; n < WINDOWS; n = n + 1) if (hit[n]) of_hit = of_hit | all[n*32+:32];
    end
  endfunction
  wire [31:0] first_index = of_hit(hits, indices);
  wire [31:0] words = of_hit(hits, facts[CAPABILITIES*32+:WINDOWS*32]);
  wire [31:0] count = {2'd0, bytes[31:2]};
  wire in_registers = address[31:12] == 20'd0;
  wire exists, writable;
  wire found = in_registers ? exists : (|hits);
  wire writes_window = hits[BIAS] | hits[STATE] | hits[WEIGHT] | hits[MOMENTUM];
  wire good_length = (bytes != 32'd0) & (bytes[1:0] == 2'd0);
  wire good_address = (address[1:0] == 2'd0) & found;
  wire leaves = ~in_registers & (first_index + count > words);
  wire allowed = in_registers ? (~write | writable) : (~busy & (~write | writes_window));
  wire [1:0] judged = !good_length ? NO_LENGTH : !good_address ? NO_ADDRESS :
                      (in_registers & (count != 32'd1)) ? NO_LENGTH : leaves ? NO_ADDRESS :
                      !allowed ? NO_COMMAND : DONE;

  // ---- the beats
  reg moving;
  reg [31:0] left;
  reg [1:0] kept_answer;
  reg kept_write, kept_register;
  reg [WINDOWS-1:0] kept_hits;
  // verilator lint_off UNUSED
  reg [31:0] next_index, index;
  // verilator lint_on UNUSED
  assign ready  = ~moving;
  assign last   = moving & (left == 32'd1);
  assign answer = kept_answer;
  wire begins = request & ~moving;
  wire moves = moving & (kept_answer == DONE);
  assign beat = moves & kept_write;
  initial begin
    {moving, kept_write, kept_register, read_valid} = 4'd0;
    {left, next_index, index} = 96'd0;
    kept_answer = DONE;
    kept_hits = {WINDOWS{1'b0}};
  end
  always @(posedge clock) begin
    if (begins) begin
      moving <= 1'b1;
      left <= (judged == DONE) ? count : 32'd1;
      kept_answer <= judged;
      kept_write <= write;
      kept_register <= in_registers;
      kept_hits <= hits;
    end else if (moving) begin
      left <= left - 32'd1;
      if (last) moving <= 1'b0;
    end
    if (begins | moving) begin
      index <= looked_up;
      next_index <= looked_up + 32'd1;
    end
    read_valid <= moves & ~kept_write;
  end
  // Tables are asked a cycle before the word moves.
  wire [31:0] looked_up = begins ? first_index : next_index;

  wire [ELEMENT_BITS+LINE_BITS-1:0] weight_place;
  wire [ELEMENT_BITS+PLACE_BITS-1:0] neuron_place;
  hm_rom #(
      .WIDTH(ELEMENT_BITS + LINE_BITS),
      .DEPTH(WEIGHTS),
      .ADDRESS(WEIGHT_INDEX),
      .FILE(WEIGHT_MAP_FILE)
  ) weight_map (
      .clock(clock),
      .address(looked_up[WEIGHT_INDEX-1:0]),
      .data(weight_place)
  );
  hm_rom #(
      .WIDTH(ELEMENT_BITS + PLACE_BITS),
      .DEPTH(NEURONS),
      .ADDRESS(NEURON_BITS),
      .FILE(NEURON_MAP_FILE)
  ) neuron_map (
      .clock(clock),
      .address(looked_up[NEURON_BITS-1:0]),
      .data(neuron_place)
  );
  wire [FIRST_BITS-1:0] first_link;
  wire [CELL_BITS-1:0] link;
  hm_rom #(
      .WIDTH(FIRST_BITS),
      .DEPTH(CELLS + 1),
      .ADDRESS(CELL_BITS),
      .FILE(FIRST_LINK_FILE)
  ) first_links (
      .clock(clock),
      .address(index[CELL_BITS-1:0]),
      .data(first_link)
  );
  hm_rom #(
      .WIDTH(CELL_BITS),
      .DEPTH((LINKS > 0) ? LINKS : 1),
      .ADDRESS(LINK_INDEX),
      .FILE(LINK_FILE)
  ) links (
      .clock(clock),
      .address(index[LINK_INDEX-1:0]),
      .data(link)
  );

  // ---- registers and array
  wire begin_run, begin_reset, cut_short, stop_by_sum, done, cleared, clearing, converged, aborted;
  wire [31:0] threshold, most_sweeps, sweeps, read_word;
  wire [5:0] stop_share;
  wire [63:0] sum_threshold, cycles;
  wire [STATE_BITS:0] largest_change;
  wire [SUM_BITS-2:0] largest_sum;
  wire signed [WEIGHT_BITS-1:0] weight;
  wire signed [BIAS_BITS-1:0] bias;
  wire signed [STATE_BITS-1:0] state;
  wire signed [15:0] m;

  hm_registers #(
      .STATE_BITS(STATE_BITS),
      .SUM_BITS(SUM_BITS),
      .CAPABILITIES(CAPABILITIES)
  ) registers (
      .clock(clock),
      .access(begins & in_registers & (judged == DONE)),
      .write(write),
      .offset(address[11:0]),
      .data(write_data),
      .capabilities(facts[CAPABILITIES*32-1:0]),
      .exists(exists),
      .writable(writable),
      .read_word(read_word),
      .irq(irq),
      .busy(busy),
      .hold(begins),
      .hold_cycles((judged == DONE) ? count + 32'd1 : 32'd2),
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

  wire [ELEMENT_BITS-1:0] host_element = kept_hits[WEIGHT] ? weight_place[LINE_BITS+:ELEMENT_BITS] :
                                         neuron_place[PLACE_BITS+:ELEMENT_BITS];
  // verilator lint_off UNUSED
  wire [31:0] last_place = facts[(CAPABILITIES+2*WINDOWS+1)*32+:32];
  wire [31:0] last_entry = facts[(CAPABILITIES+2*WINDOWS+2)*32+:32];
  // verilator lint_on UNUSED
  hm_array #(
      .ELEMENTS(ELEMENTS),
      .SHARED(SHARED),
      .OUTPUT(OUTPUT),
      .NORMALISER(NORMALISER),
      .PIPELINE(PIPELINE),
      .SYNCHRONOUS(SYNCHRONOUS),
      .WEIGHT_BITS(WEIGHT_BITS),
      .WEIGHT_FRACTION(WEIGHT_FRACTION),
      .BIAS_BITS(BIAS_BITS),
      .BIAS_FRACTION(BIAS_FRACTION),
      .SUM_BITS(SUM_BITS),
      .SUM_FRACTION(SUM_FRACTION),
      .DRIVE_BITS(DRIVE_BITS),
      .DRIVE_FRACTION(DRIVE_FRACTION),
      .DRIVE_MODE(DRIVE_MODE),
      .DRIVE_OVERFLOW(DRIVE_OVERFLOW),
      .STATE_BITS(STATE_BITS),
      .STATE_FRACTION(STATE_FRACTION),
      .STATE_MODE(STATE_MODE),
      .LINK_BITS(LINK_BITS),
      .LINK_FRACTION(LINK_FRACTION),
      .LINK_MODE(LINK_MODE),
      .MANTISSA(MANTISSA),
      .RELAXATION(RELAXATION),
      .ENTRIES(ENTRIES),
      .LINES(LINES),
      .ROUNDS(ROUNDS),
      .PLACES(PLACES),
      .LINES_FILE(LINES_FILE),
      .ROUNDS_FILE(ROUNDS_FILE)
  ) array (
      .clock(clock),
      .begin_run(begin_run),
      .begin_reset(begin_reset),
      .cut_short(cut_short),
      .reset_cycles(facts[(CAPABILITIES+2*WINDOWS)*32+:32]),
      .threshold(threshold),
      .most_sweeps(most_sweeps),
      .stop_by_sum(stop_by_sum),
      .stop_share(stop_share),
      .sum_threshold(sum_threshold),
      .last_place(last_place[PLACE_BITS-1:0]),
      .last_entry(last_entry[ENTRY_BITS-1:0]),
      .host_element(host_element),
      .host_line(weight_place[LINE_BITS-1:0]),
      .host_place(neuron_place[PLACE_BITS-1:0]),
      .weight_write(beat & kept_hits[WEIGHT]),
      .bias_write(beat & kept_hits[BIAS]),
      .state_write(beat & kept_hits[STATE]),
      .host_entry(index[ENTRY_BITS-1:0]),
      .entry_write(beat & kept_hits[MOMENTUM]),
      .host_data(write_data),
      .host_weight(weight),
      .host_bias(bias),
      .host_state(state),
      .host_m(m),
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

  // ---- what is read, a cycle behind the beat
  reg [31:0] register_word = 32'd0;
  reg [WINDOWS-1:0] read_hits = {WINDOWS{1'b0}};
  always @(posedge clock) begin
    register_word <= read_word;
    read_hits <= kept_register ? {WINDOWS{1'b0}} : kept_hits;
  end
  wire signed [31:0] wide_weight, wide_bias, wide_state;
  hm_resize #(
      .FROM(WEIGHT_BITS),
      .TO(32)
  ) resize_weight (
      .number (weight),
      .resized(wide_weight)
  );
  hm_resize #(
      .FROM(BIAS_BITS),
      .TO(32)
  ) resize_bias (
      .number (bias),
      .resized(wide_bias)
  );
  hm_resize #(
      .FROM(STATE_BITS),
      .TO(32)
  ) resize_state (
      .number (state),
      .resized(wide_state)
  );
  assign read_data = read_hits[WEIGHT] ? wide_weight : read_hits[STATE] ? wide_state :
                     read_hits[BIAS] ? wide_bias : read_hits[MOMENTUM] ? {{16{m[15]}}, m} :
                     read_hits[FIRST_LINK] ? {{(32 - FIRST_BITS) {1'b0}}, first_link} :
                     read_hits[LINK] ? {{(32 - CELL_BITS) {1'b0}}, link} : register_word;
endmodule
