// A processing element: the rows of its neurons, a memory of all links, an accumulator, and what it holds for the
// output stage. Where SUBS is above 1, links come from as many memories, each written by somebody else. With
// DOUBLE = 1 every link is two codes: of Y above that of V.
module hm_element #(
    parameter WEIGHT_BITS = 16,
    parameter LINK_BITS = 16,
    parameter LINK_FRACTION = 14,
    parameter SUM_BITS = 39,
    parameter PRODUCT_UP = 0,
    parameter LINES = 2048,
    parameter LINE_BITS = 11,
    parameter SUBS = 1,
    parameter SUB_BITS = 1,
    parameter LINK_DEPTH = 1024,
    parameter LINK_ADDRESS = 10,
    parameter DOUBLE = 0,
    parameter OWN_NORM = 0,      // norms are of the own tap alone
    parameter LINK_WORD = LINK_BITS * (1 + DOUBLE)
) (
    input  wire                           clock,
    // What the host writes and reads. Nobody reads a row while it does.
    input  wire                           weight_write,
    input  wire        [   LINE_BITS-1:0] weight_address,
    input  wire signed [ WEIGHT_BITS-1:0] weight_data,
    output wire signed [ WEIGHT_BITS-1:0] weight,
    // Memories are read for the next tap.
    input  wire                           read,
    input  wire                           read_weight,
    input  wire        [   LINE_BITS-1:0] line,
    input  wire        [LINK_ADDRESS-1:0] source,
    // verilator lint_off UNUSED
    input  wire        [    SUB_BITS-1:0] source_sub,
    input  wire                           tap_is_own,
    input  wire                           show_state,
    // verilator lint_on UNUSED
    input  wire                           tap,          // there is one in this line
    // A tap is added.
    input  wire                           add,
    input  wire                           norms,
    input  wire                           leave,
    output wire signed [    SUM_BITS-1:0] held,
    // Links are written.
    input  wire        [        SUBS-1:0] link_write,
    input  wire        [LINK_ADDRESS-1:0] link_address,
    input  wire   [SUBS*LINK_WORD-1:0] link_data
);
  wire [SUBS*LINK_WORD-1:0] links;
  wire [LINK_WORD-1:0] link_word;
  wire signed [LINK_BITS-1:0] link;
  wire signed [SUM_BITS-1:0] total;
  reg active = 1'b0;
  reg signed [SUM_BITS-1:0] kept = {SUM_BITS{1'b0}};
  assign held = kept;

  hm_ram #(
      .WIDTH(WEIGHT_BITS),
      .DEPTH(LINES),
      .ADDRESS(LINE_BITS)
  ) rows (
      .clock(clock),
      .write(weight_write),
      .write_address(weight_address),
      .write_data(weight_data),
      .read(read_weight),
      .read_address(line),
      .read_data(weight)
  );
  genvar k;
  generate
    for (k = 0; k < SUBS; k = k + 1) begin : sub
      hm_ram #(
          .WIDTH(LINK_WORD),
          .DEPTH(LINK_DEPTH),
          .ADDRESS(LINK_ADDRESS)
      ) links_of (
          .clock(clock),
          .write(link_write[k]),
          .write_address(link_address),
          .write_data(link_data[k*LINK_WORD+:LINK_WORD]),
          .read(read),
          .read_address(source),
          .read_data(links[k*LINK_WORD+:LINK_WORD])
      );
    end
    if (SUBS == 1) begin : single
      assign link_word = links;
    end else begin : many
      reg [SUB_BITS-1:0] selected = {SUB_BITS{1'b0}};
      always @(posedge clock) if (read) selected <= source_sub;
      assign link_word = links[selected*LINK_WORD+:LINK_WORD];
    end
    if (DOUBLE != 0) begin : two
      assign link = show_state ? link_word[LINK_BITS-1:0] : link_word[2*LINK_BITS-1:LINK_BITS];
    end else begin : one
      assign link = link_word;
    end
  endgenerate

  wire adds;
  generate
    if (OWN_NORM != 0) begin : own
      reg is_own = 1'b0;
      always @(posedge clock) if (read) is_own <= tap_is_own;
      assign adds = add & active & (is_own | ~norms);
    end else begin : all
      assign adds = add & active;
    end
  endgenerate

  hm_accumulator #(
      .WEIGHT_BITS(WEIGHT_BITS),
      .LINK_BITS(LINK_BITS),
      .LINK_FRACTION(LINK_FRACTION),
      .SUM_BITS(SUM_BITS),
      .PRODUCT_UP(PRODUCT_UP)
  ) accumulator (
      .clock (clock),
      .add   (adds),
      .clear (leave),
      .norms (norms),
      .weight(weight),
      .link  (link),
      .total (total)
  );

  always @(posedge clock) begin
    if (read) active <= tap;
    if (leave) kept <= total;
  end
endmodule
