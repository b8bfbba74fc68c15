// A core that is not ours: reads a blank file of test vectors, computes, and fills it in. Written from
// docs/use/test-vectors.md, docs/hardware/datapath.md and docs/hardware/cycles.md alone; it shares no line
// with the rest of the tree, and every number is an exact fraction until a register takes it.
//   other_core BLANK FILLED [K]     K: the K-th output (from 1) comes out one too high, as from a faulty core
#include "tests/other_core/built_core.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace other;

struct Core : BuiltCore {
  std::vector<Wide> I, V, L, Y, moves, table; // moves: of V in a sweep; table: of m
  Wide largest_move = 0, largest_sum = 0, along = 0;
  std::size_t entry = 0;

  void choose_sum() {
    if (!exact) return;
    sum.fraction = std::max(weight.fraction + link.fraction, bias.fraction);
    const Wide bound = Wide(longest()) * (Wide{1} << (weight.width - weight.fraction - 1)) +
                       (Wide{1} << (bias.width - bias.fraction - 1)); // of s, in whole units
    int integer_bits = 1;
    while (bound >= Wide{1} << (integer_bits - 1)) ++integer_bits;
    sum.width = sum.fraction + integer_bits;
  }

  void show(std::size_t i, Wide x) { L[i] = quantised(x, 1, link.fraction - state.fraction, link); }
  Wide in_box(Wide x) const {
    const Wide one = Wide{1} << state.fraction;
    return std::min(std::max(x, -one), one);
  }

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

  /// N, or what stands for it, in units of 2^-max(F_weight, F_bias).
  Wide divisor(std::size_t i) const {
    const int unit = std::max(weight.fraction, bias.fraction);
    const auto in_units = [&](Wide w) { return magnitude(w) << (unit - weight.fraction); };
    if (output == "projected") return in_units(row[i][i % static_cast<std::size_t>(per_cell)]);
    Wide N = output == "momentum" ? 0 : magnitude(I[i]) << (unit - bias.fraction);
    for (Wide w : row[i]) N += in_units(w);
    return N;
  }

  Wide driven(std::size_t i, Wide s) const {
    const Wide one = Wide{1} << drive.fraction, far = output == "projected" ? 2 * one : one;
    const bool steps = output == "projected" || output == "momentum";
    const Wide N = divisor(i);
    if (output == "binary" || (steps && N == 0)) return s > 0 ? far : s < 0 ? -far : 0;
    const int places = std::max(weight.fraction, bias.fraction) + drive.fraction - sum.fraction;
    const auto made = [&](Wide a, Wide b, int up) {
      if (!steps) return quantised(a, b, up, drive);
      if (output == "projected") a *= relaxation, b *= 16;
      return scaled(a, b, up, drive.rounding);
    };
    Wide u = 0;
    if (normaliser == "prescaled")
      u = made(s, 1, drive.fraction - sum.fraction);
    else if (N != 0 && normaliser == "divider")
      u = made(s, N, places);
    else if (N != 0) {
      int bits = 0;
      while (N >> bits != 0) ++bits;
      const int exponent = bits + reciprocal_bits - 2;
      u = made(s * ((Wide{1} << exponent) / N), 1, places - exponent);
    }
    return std::min(std::max(u, -far), far);
  }

  Wide output_after(std::size_t i, Wide u) const {
    if (output == "projected")
      return in_box(V[i] + scaled(u, 1, state.fraction - drive.fraction, state.rounding));
    if (output == "momentum")
      return in_box(Y[i] + scaled(u, 1, state.fraction - drive.fraction, state.rounding));
    const Wide one = Wide{1} << state.fraction;
    return V[i] + scaled((u >= 0 ? one - V[i] : one + V[i]) * u, 1, -drive.fraction, state.rounding);
  }

  void fire(std::size_t i, const std::vector<Wide>& seen) {
    const Wide bound = Wide{1} << link.fraction, s = accumulate(i, seen);
    const bool held = (seen[i] == bound && s >= 0) || (seen[i] == -bound && s <= 0);
    const Wide after = output_after(i, driven(i, s));
    moves[i] = after - V[i];
    V[i] = after;
    show(i, after);
    largest_move = std::max(largest_move, magnitude(moves[i]));
    if (by_sum && !held) largest_sum = std::max(largest_sum, magnitude(s));
    along += s > 0 ? moves[i] : s < 0 ? -moves[i] : 0;
  }

  /// The check of a sweep.
  void look_ahead() {
    const bool restart = along < 0;
    if (output == "momentum") {
      for (std::size_t i = 0; i < V.size(); ++i) {
        const Wide more = scaled(table[entry] * moves[i], 1, -15, state.rounding);
        Y[i] = restart ? V[i] : in_box(V[i] + more);
        show(i, Y[i]);
      }
      entry = std::min(restart ? std::size_t{1} : entry + 1, table.size() - 1);
    }
  }
};

long faulty_output = 0, outputs = 0;

bool is_over(const Core& core, Wide first_sum) {
  if (!core.by_sum) return core.largest_move <= core.threshold;
  return core.largest_sum <= std::max(core.sum_threshold, core.share > 0 ? first_sum >> core.share : 0);
}

void answer(Core& core, std::ostream& out) {
  long cycle = 1 + core.prepare(), sweep = 0;
  Wide first_sum = 0;
  bool over = false;
  do {
    sweep += 1, core.largest_move = core.largest_sum = core.along = 0;
    for (std::size_t k = 0; k < core.phases.size(); ++k) {
      const std::vector<Wide> seen = core.L; // by all that fire together
      cycle += core.length(core.phases[k]);
      out << "fire " << sweep << ' ' << k << ' ' << cycle - 1;
      for (long i : core.phases[k]) {
        core.fire(static_cast<std::size_t>(i), seen);
        const bool fault = ++outputs == faulty_output;
        out << ' ' << static_cast<long>(core.V[static_cast<std::size_t>(i)]) + fault;
      }
      out << '\n';
    }
    cycle += 1;
    core.look_ahead();
    if (sweep == 1) first_sum = core.largest_sum;
    over = is_over(core, first_sum);
  } while (!over && sweep < core.max_sweeps);
  out << "end " << sweep << ' ' << over << ' ' << static_cast<long>(core.largest_move) << ' '
      << static_cast<long>(core.largest_sum) << ' ' << cycle << '\n';
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
  core.show(core.L.size() - 1, core.V.back());
  core.Y.push_back(core.V.back());
  core.moves.push_back(0);
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
  if (key == "relaxation") words >> core.relaxation;
  if (key == "stop") words >> word, core.by_sum = word == "sum";
  if (key == "share") words >> core.share;
  if (key == "sum_threshold") {
    unsigned long whole = 0;
    words >> whole;
    core.sum_threshold = whole;
  }
  if (key == "momentum")
    for (long m = 0; words >> m;) core.table.push_back(low_bits(m, 16));
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
