// The folded array without its bus: elements, one output stage or one each, sequencer and detector, and the tables
// that make an array the array of a network. Parameters are in units of bits unless they say otherwise; modes are
// numbered as in the capability registers.
module hm_array #(
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
    parameter ENTRIES = 256,       // of the table of m
    parameter LINES = 2048,        // places of an element for weights
    parameter ROUNDS = 128,        // of a sweep
    parameter PLACES = 1140,       // neurons of a stage
    parameter LINES_FILE = "",
    parameter ROUNDS_FILE = "",
    // Those that follow from the ones above.
    parameter LINE_BITS = (LINES > 1) ? $clog2(LINES) : 1,
    parameter PLACE_BITS = (PLACES > 1) ? $clog2(PLACES) : 1,
    parameter ELEMENT_BITS = (ELEMENTS > 1) ? $clog2(ELEMENTS) : 1,
    parameter ENTRY_BITS = (ENTRIES > 1) ? $clog2(ENTRIES) : 1
) (
    input  wire                           clock,
    input  wire                           begin_run,
    input  wire                           begin_reset,
    input  wire                           cut_short,
    input  wire        [            31:0] reset_cycles,
    input  wire        [            31:0] threshold,
    input  wire        [            31:0] most_sweeps,
    input  wire                           stop_by_sum,
    input  wire        [             5:0] stop_share,
    input  wire        [            63:0] sum_threshold,
    input  wire        [  PLACE_BITS-1:0] last_place,
    input  wire        [  ENTRY_BITS-1:0] last_entry,
    // The host, while nothing works: a place, what to write there, and a cycle later what stands there.
    input  wire        [ELEMENT_BITS-1:0] host_element,  // of a row; of a neuron where stages are many
    input  wire        [   LINE_BITS-1:0] host_line,
    input  wire        [  PLACE_BITS-1:0] host_place,
    input  wire                           weight_write,
    input  wire                           bias_write,
    input  wire                           state_write,
    // verilator lint_off UNUSED
    input  wire        [  ENTRY_BITS-1:0] host_entry,
    input  wire                           entry_write,
    input  wire        [            31:0] host_data,
    // verilator lint_on UNUSED
    output wire signed [ WEIGHT_BITS-1:0] host_weight,
    output wire signed [   BIAS_BITS-1:0] host_bias,
    output wire signed [  STATE_BITS-1:0] host_state,
    output wire signed [            15:0] host_m,
    output wire                           done,
    output wire                           cleared,
    output wire                           clearing,
    output wire                           converged,
    output wire                           aborted,
    output wire        [            31:0] sweeps,
    output wire        [            63:0] cycles,
    output wire        [    STATE_BITS:0] largest_change,
    output wire        [    SUM_BITS-2:0] largest_sum
);
  localparam MODIFIED = 0, BINARY = 1, PROJECTED = 2, MOMENTUM = 3;
  localparam RECIPROCAL = 1, DIVIDER = 2;
  localparam HAS_NORM = (OUTPUT != BINARY) && (NORMALISER != 0) ? 1 : 0;
  localparam NORMALISE = (HAS_NORM == 0) ? 1 : (NORMALISER == RECIPROCAL) ? 2 :
                         DRIVE_FRACTION + ((OUTPUT == PROJECTED) ? 3 : 2);
  localparam STAGE_CYCLES = NORMALISE + ((OUTPUT == MODIFIED || OUTPUT == MOMENTUM) ? 2 : 1) + PIPELINE;
  localparam PREPARE_DEPTH = (NORMALISER == RECIPROCAL) ? MANTISSA + 1 : (SHARED != 0) ? 1 : 0;
  localparam NORM_FRACTION = (WEIGHT_FRACTION > BIAS_FRACTION) ? WEIGHT_FRACTION : BIAS_FRACTION;
  localparam NORM_BITS = SUM_BITS - 1 - SUM_FRACTION + NORM_FRACTION;
  localparam SHIFT_BITS = $clog2(NORM_BITS);
  localparam KEPT_BITS = (NORMALISER == DIVIDER) ? NORM_BITS : SHIFT_BITS + MANTISSA;
  localparam UNITS = (SHARED != 0) ? 1 : ELEMENTS;
  localparam SUBS = UNITS;
  localparam SUB_BITS = (SUBS > 1) ? $clog2(SUBS) : 1;
  localparam COUNT_BITS = $clog2(ELEMENTS + 1);
  localparam ROUND_BITS = (ROUNDS > 1) ? $clog2(ROUNDS) : 1;
  localparam LINK_ADDRESS = PLACE_BITS + SYNCHRONOUS;
  localparam LINK_DEPTH = (SYNCHRONOUS != 0) ? (1 << PLACE_BITS) + PLACES : PLACES;
  localparam DOUBLE = (OUTPUT == MOMENTUM) ? 1 : 0;
  localparam LINK_WORD = LINK_BITS * (1 + DOUBLE);
  localparam OWN = (OUTPUT == PROJECTED) ? 1 : 0;
  // A line of the table: for each element {own tap, tap, sub, source}, behind three flags.
  localparam TAP_AT = PLACE_BITS + ((SUBS > 1) ? SUB_BITS : 0);
  localparam FIELD_BITS = TAP_AT + 1 + OWN;
  localparam LINE_WORD = 3 + ELEMENTS * FIELD_BITS;
  localparam WAY_BITS = STATE_BITS + 3 + PLACE_BITS + ELEMENT_BITS;

  wire read, add, norms, leave, take, take_norm, begin_sweep, by_sum, bank, show_state, running;
  wire [LINE_BITS-1:0] line, line_address;
  wire [ROUND_BITS-1:0] round_address;
  wire [LINE_WORD-1:0] line_word;
  wire [COUNT_BITS+1:0] round_word;
  wire [COUNT_BITS-1:0] slot, slots;
  wire [ENTRY_BITS-1:0] entry;
  // verilator lint_off UNUSED
  wire [31:0] clear_address;
  // verilator lint_on UNUSED
  wire wrong_way;

  hm_rom #(
      .WIDTH(LINE_WORD),
      .DEPTH(LINES),
      .ADDRESS(LINE_BITS),
      .FILE(LINES_FILE)
  ) lines_table (
      .clock(clock),
      .address(line_address),
      .data(line_word)
  );
  hm_rom #(
      .WIDTH(COUNT_BITS + 2),
      .DEPTH(ROUNDS),
      .ADDRESS(ROUND_BITS),
      .FILE(ROUNDS_FILE)
  ) rounds_table (
      .clock(clock),
      .address(round_address),
      .data(round_word)
  );

  hm_sequencer #(
      .SHARED(SHARED),
      .STAGE_CYCLES(STAGE_CYCLES),
      .HAS_PREPARE(HAS_NORM),
      .PREPARE_DEPTH(PREPARE_DEPTH),
      .LINE_BITS(LINE_BITS),
      .ROUND_BITS(ROUND_BITS),
      .COUNT_BITS(COUNT_BITS),
      .STATE_BITS(STATE_BITS),
      .SUM_BITS(SUM_BITS),
      .HAS_MOMENTUM(DOUBLE),
      .ENTRY_BITS(ENTRY_BITS),
      .TWO_BANKS(SYNCHRONOUS)
  ) sequencer (
      .clock(clock),
      .begin_run(begin_run),
      .begin_reset(begin_reset),
      .cut_short(cut_short),
      .reset_cycles(reset_cycles),
      .threshold(threshold),
      .most_sweeps(most_sweeps),
      .stop_by_sum(stop_by_sum),
      .stop_share(stop_share),
      .sum_threshold(sum_threshold),
      .last_entry(last_entry),
      .wrong_way(wrong_way),
      .line_address(line_address),
      .round_address(round_address),
      .line_ends_round(line_word[0]),
      .line_ends_phase(line_word[1]),
      .line_ends_sweep(line_word[2]),
      .round_count(round_word[COUNT_BITS+1:2]),
      .round_ends_phase(round_word[0]),
      .round_ends_sweep(round_word[1]),
      .line(line),
      .read(read),
      .add(add),
      .norms(norms),
      .leave(leave),
      .take(take),
      .take_norm(take_norm),
      .slot(slot),
      .slots(slots),
      .begin_sweep(begin_sweep),
      .by_sum(by_sum),
      .bank(bank),
      .show_state(show_state),
      .entry(entry),
      .clearing(clearing),
      .clear_address(clear_address),
      .largest_change(largest_change),
      .largest_sum(largest_sum),
      .done(done),
      .cleared(cleared),
      .running(running),
      .converged(converged),
      .aborted(aborted),
      .sweeps(sweeps),
      .cycles(cycles)
  );

  // ---- places: neurons pass a stage in the order of their places
  // Element 0 has a neuron in every round.
  // verilator lint_off UNUSED
  wire [UNITS-1:0] norm_ready;
  // verilator lint_on UNUSED
  wire [UNITS-1:0] publish;
  reg [PLACE_BITS-1:0] place = {PLACE_BITS{1'b0}};
  reg [PLACE_BITS-1:0] norm_place = {PLACE_BITS{1'b0}};
  reg [PLACE_BITS-1:0] publish_place = {PLACE_BITS{1'b0}};
  wire [PLACE_BITS-1:0] next_place = !take ? place : (place == last_place) ? {PLACE_BITS{1'b0}} :
                                     place + {{(PLACE_BITS - 1) {1'b0}}, 1'b1};
  always @(posedge clock) begin
    place <= next_place;
    if (norm_ready[0])
      norm_place <= (norm_place == last_place) ? {PLACE_BITS{1'b0}} : norm_place + {{(PLACE_BITS - 1) {1'b0}}, 1'b1};
    if (publish[0])
      publish_place <= (publish_place == last_place) ? {PLACE_BITS{1'b0}} :
                       publish_place + {{(PLACE_BITS - 1) {1'b0}}, 1'b1};
  end
  wire [PLACE_BITS-1:0] read_place = running ? next_place : host_place;
  wire [PLACE_BITS-1:0] write_place = clearing ? clear_address[PLACE_BITS-1:0] : host_place;

  // ---- what the host writes: the low bits of a word, V held within 1
  wire signed [STATE_BITS-1:0] loaded_state;
  wire signed [LINK_BITS-1:0] loaded_link;
  // verilator lint_off UNUSED
  wire [31:0] word = clearing ? 32'd0 : host_data;
  // verilator lint_on UNUSED
  hm_limit #(
      .FROM(STATE_BITS),
      .UNIT(STATE_FRACTION),
      .TO(STATE_BITS)
  ) limit (
      .code(word[STATE_BITS-1:0]),
      .limited(loaded_state)
  );
  hm_round_places #(
      .FROM(STATE_BITS),
      .DOWN(STATE_FRACTION - LINK_FRACTION),
      .TO(LINK_BITS),
      .MODE(LINK_MODE),
      .MAGNITUDE(0)
  ) round_loaded (
      .number(loaded_state),
      .negative(1'b0),
      .rounded(loaded_link)
  );

  // ---- elements
  wire signed [WEIGHT_BITS*ELEMENTS-1:0] weights;
  wire [SUM_BITS*ELEMENTS-1:0] held;
  wire [UNITS*LINK_WORD-1:0] link_data;
  wire [SUBS-1:0] link_write;
  wire [LINK_ADDRESS-1:0] link_address, source_bank;
  wire [LINE_BITS-1:0] row_line = running ? line : host_line;
  wire [LINE_BITS-1:0] row_address = clearing ? clear_address[LINE_BITS-1:0] : host_line;
  generate
    if (SYNCHRONOUS != 0) begin : banks
      assign link_address = {running ? ~bank : bank, running ? publish_place : write_place};
      assign source_bank  = {bank, {PLACE_BITS{1'b0}}};
    end else begin : no_banks
      assign link_address = running ? publish_place : write_place;
      assign source_bank  = {LINK_ADDRESS{1'b0}};
      // verilator lint_off UNUSED
      wire unused = bank;
      // verilator lint_on UNUSED
    end
  endgenerate
  genvar e;
  generate
    for (e = 0; e < ELEMENTS; e = e + 1) begin : elements
      localparam [31:0] NUMBER = e;
      wire [FIELD_BITS-1:0] field = line_word[3+e*FIELD_BITS+:FIELD_BITS];
      wire [LINK_ADDRESS-1:0] source;
      wire [SUB_BITS-1:0] sub;
      wire own;
      if (SYNCHRONOUS != 0) begin : banked
        assign source = source_bank | {1'b0, field[PLACE_BITS-1:0]};
      end else begin : plain
        assign source = source_bank | field[PLACE_BITS-1:0];
      end
      if (SUBS > 1) begin : many
        assign sub = field[PLACE_BITS+:SUB_BITS];
      end else begin : single
        assign sub = {SUB_BITS{1'b0}};
      end
      if (OWN != 0) begin : marked
        assign own = field[FIELD_BITS-1];
      end else begin : unmarked
        assign own = 1'b0;
      end
      hm_element #(
          .WEIGHT_BITS(WEIGHT_BITS),
          .LINK_BITS(LINK_BITS),
          .LINK_FRACTION(LINK_FRACTION),
          .SUM_BITS(SUM_BITS),
          .PRODUCT_UP(SUM_FRACTION - WEIGHT_FRACTION - LINK_FRACTION),
          .LINES(LINES),
          .LINE_BITS(LINE_BITS),
          .SUBS(SUBS),
          .SUB_BITS(SUB_BITS),
          .LINK_DEPTH(LINK_DEPTH),
          .LINK_ADDRESS(LINK_ADDRESS),
          .DOUBLE(DOUBLE),
          .OWN_NORM(OWN)
      ) element (
          .clock(clock),
          .weight_write(clearing | (weight_write & (host_element == NUMBER[ELEMENT_BITS-1:0]))),
          .weight_address(row_address),
          .weight_data(word[WEIGHT_BITS-1:0]),
          .weight(weights[e*WEIGHT_BITS+:WEIGHT_BITS]),
          .read(read),
          .read_weight(read | ~running),
          .line(row_line),
          .source(source),
          .source_sub(sub),
          .tap_is_own(own),
          .show_state(show_state),
          .tap(field[TAP_AT]),
          .add(add),
          .norms(norms),
          .leave(leave),
          .held(held[e*SUM_BITS+:SUM_BITS]),
          .link_write(link_write),
          .link_address(link_address),
          .link_data(link_data)
      );
    end
  endgenerate

  // ---- stages
  wire [UNITS*BIAS_BITS-1:0] biases;
  wire [UNITS*STATE_BITS-1:0] states;
  wire [UNITS-1:0] judged, free, sum_negative, sum_zero;
  wire [UNITS*(SUM_BITS-1)-1:0] sizes;
  wire [UNITS*(STATE_BITS+1)-1:0] changes;
  wire signed [15:0] momentum;
  genvar u;
  generate
    for (u = 0; u < UNITS; u = u + 1) begin : stages
      localparam [31:0] NUMBER = u;
      wire signed [SUM_BITS-1:0] goes_in;
      wire mine, takes;
      wire signed [LINK_BITS-1:0] state_link, point_link;
      if (SHARED != 0) begin : shared
        assign goes_in = held[slot*SUM_BITS+:SUM_BITS];
        assign mine = 1'b1;
        assign takes = take;
        // verilator lint_off UNUSED
        wire unused = ^slots;
        // verilator lint_on UNUSED
      end else begin : each
        assign goes_in = held[u*SUM_BITS+:SUM_BITS];
        assign mine = host_element == NUMBER[ELEMENT_BITS-1:0];
        assign takes = take & (NUMBER[COUNT_BITS-1:0] < slots);
        // verilator lint_off UNUSED
        wire unused = ^slot;
        // verilator lint_on UNUSED
      end
      wire loads = clearing | (state_write & mine);
      hm_unit #(
          .OUTPUT(OUTPUT),
          .NORMALISER(NORMALISER),
          .PIPELINE(PIPELINE),
          .PIPELINED(SHARED),
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
          .NORM_BITS(NORM_BITS),
          .SHIFT_BITS(SHIFT_BITS),
          .KEPT_BITS(KEPT_BITS),
          .PLACES(PLACES),
          .PLACE_BITS(PLACE_BITS)
      ) unit (
          .clock(clock),
          .take(takes & ~take_norm),
          .take_norm(takes & take_norm),
          .held(goes_in),
          .momentum(momentum),
          .show_state(show_state),
          .read_place(read_place),
          .norm_place(norm_place),
          .publish_place(publish_place),
          .bias_write(clearing | (bias_write & mine)),
          .state_write(loads),
          .write_place(write_place),
          .bias_data(word[BIAS_BITS-1:0]),
          .state_data(loaded_state),
          .bias(biases[u*BIAS_BITS+:BIAS_BITS]),
          .state(states[u*STATE_BITS+:STATE_BITS]),
          .norm_ready(norm_ready[u]),
          .judged(judged[u]),
          .free(free[u]),
          .size(sizes[u*(SUM_BITS-1)+:SUM_BITS-1]),
          .publish(publish[u]),
          .sum_negative(sum_negative[u]),
          .sum_zero(sum_zero[u]),
          .change(changes[u*(STATE_BITS+1)+:STATE_BITS+1]),
          .state_link(state_link),
          .point_link(point_link)
      );
      assign link_write[u] = publish[u] | loads;
      if (DOUBLE != 0) begin : both
        assign link_data[u*LINK_WORD+:LINK_WORD] = publish[u] ? {point_link, state_link} : {2{loaded_link}};
      end else begin : one
        assign link_data[u*LINK_WORD+:LINK_WORD] = publish[u] ? state_link : loaded_link;
        // verilator lint_off UNUSED
        wire unused_link = ^point_link;
        // verilator lint_on UNUSED
      end
    end
  endgenerate

  hm_detector #(
      .SPOKEN(UNITS),
      .STATE_BITS(STATE_BITS),
      .SUM_BITS(SUM_BITS),
      .HAS_WAY(DOUBLE),
      .WAY_BITS(WAY_BITS)
  ) detector (
      .clock(clock),
      .begin_sweep(begin_sweep),
      .by_sum(by_sum),
      .judged(judged),
      .free(free),
      .sizes(sizes),
      .publish(publish),
      .sum_negative(sum_negative),
      .sum_zero(sum_zero),
      .changes(changes),
      .largest_change(largest_change),
      .largest_sum(largest_sum),
      .wrong_way(wrong_way)
  );

  generate
    if (DOUBLE != 0) begin : table_of_m
      hm_ram #(
          .WIDTH(16),
          .DEPTH(ENTRIES),
          .ADDRESS(ENTRY_BITS)
      ) codes (
          .clock(clock),
          .write(clearing | entry_write),
          .write_address(clearing ? clear_address[ENTRY_BITS-1:0] : host_entry),
          .write_data(word[15:0]),
          .read(1'b1),
          .read_address(running ? entry : host_entry),
          .read_data(momentum)
      );
    end else begin : no_table
      assign momentum = 16'sd0;
      // verilator lint_off UNUSED
      wire unused = ^entry;
      // verilator lint_on UNUSED
    end
  endgenerate
  assign host_m = momentum;

  // ---- what the host reads: of the element that was asked a cycle ago
  reg [ELEMENT_BITS-1:0] asked = {ELEMENT_BITS{1'b0}};
  always @(posedge clock) asked <= host_element;
  assign host_weight = weights[asked*WEIGHT_BITS+:WEIGHT_BITS];
  generate
    if (UNITS > 1) begin : of_many
      assign host_bias  = biases[asked*BIAS_BITS+:BIAS_BITS];
      assign host_state = states[asked*STATE_BITS+:STATE_BITS];
    end else begin : of_one
      assign host_bias  = biases;
      assign host_state = states;
    end
  endgenerate
endmodule
