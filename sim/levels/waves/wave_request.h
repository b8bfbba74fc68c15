// What --wave, --wave-window and --wave-cells ask for, whichever level draws the wave.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hopmesh::levels {

struct WaveRequest {
  std::string file;                           ///< FILE.vcd; empty: no wave
  bool in_cycles = false;                     ///< the window counts cycles of all runs so far, not steps
  std::uint64_t first = 0, last = UINT64_MAX; ///< [first, last)
  std::vector<std::size_t> cells;             ///< empty: all
};

/// "3:5" (steps), "1000:2000c" (cycles); either end may be left out. Throws input::InputError.
void parse_window(const std::string& text, WaveRequest& request);
/// "0,4,10-12". Throws input::InputError.
std::vector<std::size_t> parse_cells(const std::string& text);

/// Throws input::InputError for a cell that the array does not have, and for a file that cannot be one.
void check_wave(const WaveRequest& request, std::size_t cells);

/// So little room that a wave had better end while it is whole.
bool disk_nearly_full(const WaveRequest& request);
std::string early_end_text(const WaveRequest& request);
/// Tells that the run ended before its window began.
void warn_empty_window(const WaveRequest& request);

} // namespace hopmesh::levels
