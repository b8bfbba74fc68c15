// What a core that is not ours was built as, and the cycles that it takes. Written from
// docs/hardware/cycles.md alone.
#pragma once

#include "tests/other_core/exact_format.h"

#include <algorithm>
#include <string>
#include <vector>

namespace other {

struct BuiltCore {
  std::string schedule, output, normaliser;
  std::string stages;
  int reciprocal_bits = 0, lanes = 1, per_cell = 3, elements = 0, pipeline = 0, relaxation = 0;
  bool exact = false, by_sum = false;
  Format weight, bias, sum, drive, state, link;
  long cells = 0, threshold = 0, max_sweeps = 1, share = 0;
  Wide sum_threshold = 0;
  std::vector<std::vector<long>> links, phases;
  std::vector<std::vector<Wide>> row; // of a neuron

  std::size_t longest() const {
    std::size_t most = 0;
    for (const auto& r : row) most = std::max(most, r.size());
    return most;
  }

  long beats(std::size_t taps) const { return (static_cast<long>(taps) + lanes - 1) / lanes; }
  long stage() const {                // S
    if (output == "binary") return 2; // the sign; V
    const long normalise = normaliser == "prescaled"    ? 1
                           : normaliser == "reciprocal" ? 2
                           : output == "projected"      ? drive.fraction + 3
                                                        : drive.fraction + 2;
    return normalise + (output == "projected" ? 1 : 2) + pipeline;
  }
  long prepare() const {
    if (output == "binary" || normaliser == "prescaled") return 0;
    const long divide = normaliser == "reciprocal" ? reciprocal_bits + 1 : 0;
    if (elements == 0) return beats(longest()) + divide;
    std::vector<std::vector<long>> rounds;
    for (const auto& phase : phases)
      for (const auto& round : folded(phase)) rounds.push_back(round);
    return length_of(rounds, divide == 0 && stages == "one" ? 1 : divide);
  }
  long length(const std::vector<long>& phase) const {
    if (elements > 0) return length_of(folded(phase), stage());
    std::size_t taps = 0;
    for (long i : phase) taps = std::max(taps, row[static_cast<std::size_t>(i)].size());
    return beats(taps) + stage();
  }

  /// Rounds of a phase that shares elements.
  std::vector<std::vector<long>> folded(std::vector<long> phase) const {
    const auto length_of_row = [this](long i) { return row[static_cast<std::size_t>(i)].size(); };
    std::sort(phase.begin(), phase.end(), [&](long a, long b) {
      return length_of_row(a) != length_of_row(b) ? length_of_row(a) > length_of_row(b) : a < b;
    });
    std::vector<std::vector<long>> rounds;
    for (std::size_t k = 0; k < phase.size(); ++k) {
      if (k % static_cast<std::size_t>(elements) == 0) rounds.emplace_back();
      rounds.back().push_back(phase[k]);
    }
    return rounds;
  }
  long length_of(const std::vector<std::vector<long>>& rounds, long depth) const {
    long cycles = 1, wait = 0;
    for (const auto& round : rounds) {
      cycles += std::max(beats(row[static_cast<std::size_t>(round[0])].size()), wait);
      wait = stages == "one" ? static_cast<long>(round.size()) : depth;
    }
    return cycles + (stages == "one" ? wait - 1 : 0) + depth;
  }
};

} // namespace other
