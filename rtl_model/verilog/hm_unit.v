// An output stage with the memories of its neurons: bias, V (and Y), and what is kept of N. A neuron has a place in
// them. Memories read the place of the neuron that goes in next.
module hm_unit #(
    parameter OUTPUT = 0,
    parameter NORMALISER = 1,
    parameter PIPELINE = 0,
    parameter PIPELINED = 1,
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
    parameter NORM_BITS = 24,
    parameter SHIFT_BITS = 5,
    parameter KEPT_BITS = 23,
    parameter PLACES = 1140,
    parameter PLACE_BITS = 11
) (
    input  wire                         clock,
    input  wire                         take,
    input  wire                         take_norm,
    input  wire signed [  SUM_BITS-1:0] held,
    input  wire signed [          15:0] momentum,
    // verilator lint_off UNUSED
    input  wire                         show_state,  // with momentum: Y is V
    // verilator lint_on UNUSED
    // Places: that is read for the next cycle, in which a norm is kept, and in which V is published.
    input  wire        [PLACE_BITS-1:0] read_place,
    input  wire        [PLACE_BITS-1:0] norm_place,
    input  wire        [PLACE_BITS-1:0] publish_place,
    // What the host, or a RESET, writes.
    input  wire                         bias_write,
    input  wire                         state_write,
    input  wire        [PLACE_BITS-1:0] write_place,
    input  wire signed [ BIAS_BITS-1:0] bias_data,
    input  wire signed [STATE_BITS-1:0] state_data,
    output wire signed [ BIAS_BITS-1:0] bias,
    output wire signed [STATE_BITS-1:0] state,
    output wire                         norm_ready,
    output wire                         judged,
    output wire                         free,
    output wire        [  SUM_BITS-2:0] size,
    output wire                         publish,
    output wire                         sum_negative,
    output wire                         sum_zero,
    output wire signed [  STATE_BITS:0] change,
    output wire signed [ LINK_BITS-1:0] state_link,
    output wire signed [ LINK_BITS-1:0] point_link
);
  wire [KEPT_BITS-1:0] kept, norm_kept;
  // verilator lint_off UNUSED
  wire signed [STATE_BITS-1:0] point, new_point;
  // verilator lint_on UNUSED
  wire signed [STATE_BITS-1:0] new_state;

  hm_ram #(
      .WIDTH(BIAS_BITS),
      .DEPTH(PLACES),
      .ADDRESS(PLACE_BITS)
  ) biases (
      .clock(clock),
      .write(bias_write),
      .write_address(write_place),
      .write_data(bias_data),
      .read(1'b1),
      .read_address(read_place),
      .read_data(bias)
  );
  hm_ram #(
      .WIDTH(STATE_BITS),
      .DEPTH(PLACES),
      .ADDRESS(PLACE_BITS)
  ) states (
      .clock(clock),
      .write(publish | state_write),
      .write_address(publish ? publish_place : write_place),
      .write_data(publish ? new_state : state_data),
      .read(1'b1),
      .read_address(read_place),
      .read_data(state)
  );
  generate
    if ((OUTPUT != 1) && (NORMALISER != 0)) begin : with_norms
      hm_ram #(
          .WIDTH(KEPT_BITS),
          .DEPTH(PLACES),
          .ADDRESS(PLACE_BITS)
      ) norms (
          .clock(clock),
          .write(norm_ready),
          .write_address(norm_place),
          .write_data(norm_kept),
          .read(1'b1),
          .read_address(read_place),
          .read_data(kept)
      );
    end else begin : without_norms
      assign kept = {KEPT_BITS{1'b0}};
      // verilator lint_off UNUSED
      wire unused = ^{norm_kept, norm_place};
      // verilator lint_on UNUSED
    end
    if (OUTPUT == 3) begin : with_points
      wire signed [STATE_BITS-1:0] ahead;
      hm_ram #(
          .WIDTH(STATE_BITS),
          .DEPTH(PLACES),
          .ADDRESS(PLACE_BITS)
      ) points (
          .clock(clock),
          .write(publish),
          .write_address(publish_place),
          .write_data(new_point),
          .read(1'b1),
          .read_address(read_place),
          .read_data(ahead)
      );
      assign point = show_state ? state : ahead;
    end else begin : without_points
      assign point = state;
    end
  endgenerate

  hm_stage #(
      .OUTPUT(OUTPUT),
      .NORMALISER(NORMALISER),
      .PIPELINE(PIPELINE),
      .PIPELINED(PIPELINED),
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
      .KEPT_BITS(KEPT_BITS)
  ) stage (
      .clock(clock),
      .take(take),
      .take_norm(take_norm),
      .held(held),
      .bias(bias),
      .kept(kept),
      .momentum(momentum),
      .state(state),
      .point(point),
      .norm_ready(norm_ready),
      .norm_kept(norm_kept),
      .judged(judged),
      .free(free),
      .size(size),
      .publish(publish),
      .sum_negative(sum_negative),
      .sum_zero(sum_zero),
      .change(change),
      .new_state(new_state),
      .new_point(new_point),
      .state_link(state_link),
      .point_link(point_link)
  );
endmodule
