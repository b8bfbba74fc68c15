// A core that is not ours: reads a blank file of test vectors, computes, and fills it in. Written from
// docs/use/test-vectors.md, docs/hardware/datapath.md and docs/hardware/cycles.md alone; it shares no line
// with the rest of the tree, and every number is an exact fraction until a register takes it.
//   other_core BLANK FILLED [K]     K: the K-th output (from 1) comes out one too high, as from a faulty core
#include "tests/other_core/exact_format.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace other;

struct Core {
  std::string schedule, output, normaliser;
  std::string stages;
  int reciprocal_bits = 0, lanes = 1, per_cell = 3, elements = 0, pipeline = 0;
  bool exact = false;
  Format weight, bias, sum, drive, state, link;
  long cells = 0, threshold = 0, max_sweeps = 1;
  std::vector<std::vector<long>> links, phases;
  std::vector<std::vector<Wide>> row; // of a neuron
  std::vector<Wide> I, V, L;

  std::size_t longest() const {
    std::size_t most = 0;
    for (const auto& r : row) most = std::max(most, r.size());
    return most;
  }

  void choose_sum() {
    if (!exact) return;
    sum.fraction = std::max(weight.fraction + link.fraction, bias.fraction);
    const Wide bound = Wide(longest()) * (Wide{1} << (weight.width - weight.fraction - 1)) +
                       (Wide{1} << (bias.width - bias.fraction - 1)); // of s, in whole units
    int integer_bits = 1;
    while (bound >= Wide{1} << (integer_bits - 1)) ++integer_bits;
    sum.width = sum.fraction + integer_bits;
  }

  void show(std::size_t i) { L[i] = quantised(V[i], 1, link.fraction - state.fraction, link); }

  Wide accumulate(std::size_t i, const std::vector<Wide>& seen) const {
    std::vector<Wide> input;
    const std::size_t cell = i / static_cast<std::size_t>(per_cell);
    std::vector<long> sources{static_cast<long>(cell)};
    sources.insert(sources.end(), links[cell].begin(), links[cell].end());
    for (long source : sources)
      for (int q = 0; q < per_cell; ++q)
        input.push_back(seen[static_cast<std::size_t>(source * per_cell + q)]);
    const int product = weight.fraction + link.fraction, fine = std::max(product, sum.fraction);
    Wide s = quantised(I[i], 1, sum.fraction - bias.fraction, sum);
    for (std::size_t tap = 0; tap < input.size();) {
      Wide total = s * (Wide{1} << (fine - sum.fraction));
      for (int lane = 0; lane < lanes && tap < input.size(); ++lane, ++tap)
        total += row[i][tap] * input[tap] * (Wide{1} << (fine - product));
      s = quantised(total, 1, sum.fraction - fine, sum);
    }
    return s;
  }

  Wide driven(std::size_t i, Wide s) const {
    const Wide one = Wide{1} << drive.fraction;
    if (output == "binary") return s > 0 ? one : s < 0 ? -one : 0;
    const int unit = std::max(weight.fraction, bias.fraction);
    Wide N = magnitude(I[i]) << (unit - bias.fraction), u = 0;
    for (Wide w : row[i]) N += magnitude(w) << (unit - weight.fraction);
    const int places = unit + drive.fraction - sum.fraction;
    if (normaliser == "prescaled")
      u = quantised(s, 1, drive.fraction - sum.fraction, drive);
    else if (N != 0 && normaliser == "divider")
      u = quantised(s, N, places, drive);
    else if (N != 0) {
      int bits = 0;
      while (N >> bits != 0) ++bits;
      const int exponent = bits + reciprocal_bits - 2;
      u = quantised(s * ((Wide{1} << exponent) / N), 1, places - exponent, drive);
    }
    return std::min(std::max(u, -one), one);
  }

  /// Returns |Delta V|.
  Wide fire(std::size_t i, const std::vector<Wide>& seen) {
    const Wide one = Wide{1} << state.fraction, u = driven(i, accumulate(i, seen));
    const Wide change =
        rounded((u >= 0 ? one - V[i] : one + V[i]) * u, Wide{1} << drive.fraction, state.rounding);
    V[i] += change;
    show(i);
    return magnitude(change);
  }

  // ---- cycles ----

  long beats(std::size_t taps) const { return (static_cast<long>(taps) + lanes - 1) / lanes; }
  long stage() const {                // S
    if (output == "binary") return 2; // the sign; V
    const long normalise = normaliser == "prescaled"    ? 1
                           : normaliser == "reciprocal" ? 2
                                                        : drive.fraction + 2;
    return normalise + 2 + pipeline;
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

long faulty_output = 0, outputs = 0;

void answer(Core& core, std::ostream& out) {
  long cycle = 1 + core.prepare(), sweep = 0;
  Wide largest = 0;
  do {
    sweep += 1, largest = 0;
    for (std::size_t k = 0; k < core.phases.size(); ++k) {
      const std::vector<Wide> seen = core.L; // by all that fire together
      cycle += core.length(core.phases[k]);
      out << "fire " << sweep << ' ' << k << ' ' << cycle - 1;
      for (long i : core.phases[k]) {
        largest = std::max(largest, core.fire(static_cast<std::size_t>(i), seen));
        const bool fault = ++outputs == faulty_output;
        out << ' ' << static_cast<long>(core.V[static_cast<std::size_t>(i)]) + fault;
      }
      out << '\n';
    }
    cycle += 1;
  } while (largest > core.threshold && sweep < core.max_sweeps);
  out << "end " << sweep << ' ' << (largest <= core.threshold) << ' ' << static_cast<long>(largest) << ' '
      << cycle << '\n';
}

void read_neuron(Core& core, std::istream& words) {
  long number = 0, start = 0, bias = 0;
  words >> number >> start >> bias;
  const Wide one = Wide{1} << core.state.fraction;
  core.V.push_back(std::min(std::max(low_bits(start, core.state.width), -one), one));
  core.I.push_back(low_bits(bias, core.bias.width));
  core.row.emplace_back();
  for (long w = 0; words >> w;) core.row.back().push_back(low_bits(w, core.weight.width));
  core.L.push_back(0);
  core.show(core.L.size() - 1);
}

std::vector<long> list(std::istream& words) {
  std::vector<long> all;
  long number = 0;
  words >> number; // its own
  while (words >> number) all.push_back(number);
  return all;
}

void take_line(Core& core, const std::string& line) {
  std::istringstream words(line);
  std::string key, word;
  words >> key;
  if (key == "case") core = Core();
  if (key == "schedule") words >> core.schedule;
  if (key == "output") words >> core.output;
  if (key == "normaliser") words >> core.normaliser;
  if (key == "reciprocal_bits") words >> core.reciprocal_bits;
  if (key == "lanes") words >> core.lanes;
  if (key == "elements") words >> core.elements;
  if (key == "stages") words >> core.stages;
  if (key == "pipeline") words >> core.pipeline;
  if (key == "cells") words >> core.cells;
  if (key == "neurons_per_cell") words >> core.per_cell;
  if (key == "threshold") words >> core.threshold;
  if (key == "max_sweeps") words >> core.max_sweeps;
  if (key == "links") core.links.push_back(list(words));
  if (key == "phase") core.phases.push_back(list(words));
  if (key == "neuron") read_neuron(core, words);
  for (auto [name, format] : {std::pair<const char*, Format*>{"weight", &core.weight},
                              {"bias", &core.bias},
                              {"accumulator", &core.sum},
                              {"drive", &core.drive},
                              {"state", &core.state},
                              {"link", &core.link}})
    if (key == name && words >> word) {
      if (word == "exact")
        core.exact = true;
      else
        *format = format_of(word);
    }
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 3) return std::cerr << "usage: other_core BLANK FILLED [K]\n", 2;
  if (argc > 3) faulty_output = std::atol(argv[3]);
  std::ifstream in(argv[1]);
  std::ofstream out(argv[2]);
  Core core;
  for (std::string line; std::getline(in, line);) {
    if (line == "?") {
      core.choose_sum();
      answer(core, out);
      continue;
    }
    out << line << '\n';
    take_line(core, line);
  }
  return out ? 0 : 1;
}
