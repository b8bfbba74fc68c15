// What a sweep came to: the largest |V' - V|, the largest |s| of neurons that may still move, and whether momentum
// carried them the wrong way. SPOKEN stages report side by side.
module hm_detector #(
    parameter SPOKEN = 1,
    parameter STATE_BITS = 24,
    parameter SUM_BITS = 39,
    parameter HAS_WAY = 0,
    parameter WAY_BITS = 40
) (
    input  wire                             clock,
    input  wire                             begin_sweep,
    input  wire                             by_sum,
    input  wire [               SPOKEN-1:0] judged,
    input  wire [               SPOKEN-1:0] free,
    input  wire [  SPOKEN*(SUM_BITS-1)-1:0] sizes,
    input  wire [               SPOKEN-1:0] publish,
    // verilator lint_off UNUSED
    input  wire [               SPOKEN-1:0] sum_negative,
    input  wire [               SPOKEN-1:0] sum_zero,
    // verilator lint_on UNUSED
    input  wire [SPOKEN*(STATE_BITS+1)-1:0] changes,
    output reg  [             STATE_BITS:0] largest_change,
    output reg  [             SUM_BITS-2:0] largest_sum,
    output wire                             wrong_way
);
  // One after the other: a chain where there are many.
  function [STATE_BITS:0] size_of(input [STATE_BITS:0] change);
    size_of = change[STATE_BITS] ? -change : change;
  endfunction
  function [STATE_BITS:0] largest_of_changes(input [STATE_BITS:0] least, input [SPOKEN-1:0] heard,
                                             input [SPOKEN*(STATE_BITS+1)-1:0] all);
    integer k;
    reg [STATE_BITS:0] next;
    begin
      largest_of_changes = least;
      for (k = 0; k < SPOKEN; k = k + 1) begin
        next = size_of(all[k*(STATE_BITS+1)+:STATE_BITS+1]);
        if (heard[k] & (next > largest_of_changes)) largest_of_changes = next;
      end
    end
  endfunction
  function [SUM_BITS-2:0] largest_of_sums(input [SUM_BITS-2:0] least, input [SPOKEN-1:0] heard,
                                          input [SPOKEN*(SUM_BITS-1)-1:0] all);
    integer k;
    reg [SUM_BITS-2:0] next;
    begin
      largest_of_sums = least;
      for (k = 0; k < SPOKEN; k = k + 1) begin
        next = all[k*(SUM_BITS-1)+:SUM_BITS-1];
        if (heard[k] & (next > largest_of_sums)) largest_of_sums = next;
      end
    end
  endfunction

  wire [SPOKEN-1:0] sums_heard = judged & free & {SPOKEN{by_sum}};
  initial largest_change = {(STATE_BITS + 1) {1'b0}};
  initial largest_sum = {(SUM_BITS - 1) {1'b0}};
  always @(posedge clock) begin
    if (begin_sweep) begin
      largest_change <= {(STATE_BITS + 1) {1'b0}};
      largest_sum <= {(SUM_BITS - 1) {1'b0}};
    end else begin
      if (|publish) largest_change <= largest_of_changes(largest_change, publish, changes);
      if (|sums_heard) largest_sum <= largest_of_sums(largest_sum, sums_heard, sizes);
    end
  end

  generate
    if (HAS_WAY != 0) begin : sums_way
      reg [WAY_BITS-1:0] way = {WAY_BITS{1'b0}};
      function [WAY_BITS-1:0] added(input [WAY_BITS-1:0] from, input [SPOKEN-1:0] heard, input [SPOKEN-1:0] minus,
                                    input [SPOKEN*(STATE_BITS+1)-1:0] all);
        integer k;
        reg [WAY_BITS-1:0] wide;
        begin
          added = from;
          for (k = 0; k < SPOKEN; k = k + 1) begin
            wide = {
              {(WAY_BITS - STATE_BITS - 1) {all[k*(STATE_BITS+1)+STATE_BITS]}}, all[k*(STATE_BITS+1)+:STATE_BITS+1]
            };
            if (heard[k]) added = minus[k] ? added - wide : added + wide;
          end
        end
      endfunction
      always @(posedge clock) begin
        if (begin_sweep) way <= {WAY_BITS{1'b0}};
        else if (|publish) way <= added(way, publish & ~sum_zero, sum_negative, changes);
      end
      assign wrong_way = way[WAY_BITS-1];
    end else begin : no_way
      assign wrong_way = 1'b0;
    end
  endgenerate
endmodule
