// A neuron that is not ours: reads a blank file of firings, computes, and fills it in. Written from
// docs/use/test-vectors.md, docs/hardware/datapath.md and docs/hardware/number-formats.md alone; every number
// is an exact fraction until a register takes it.
//   other_neuron BLANK FILLED [FIRING COLUMN MORE]     in that firing, from 0, the register of that column
//   holds so much more than it should, and whatever follows from it goes wrong as well
#include "tests/other_core/exact_format.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <vector>

namespace {

using namespace other;

struct Fault {
  long firing = -1;
  std::string column;
  Wide more = 0;
};

struct Neuron {
  std::map<std::string, std::string> keys;
  Format weight, bias, sum, drive, state, link;
  int lanes = 1, reciprocal_bits = 0;
  std::size_t most_taps = 0;
  std::map<std::string, std::vector<Wide>> cells; // of the firing at hand, by column
  Fault fault;
  long firing = 0;

  // ---- what a register holds ----

  Wide put(const std::string& column, Wide x, std::size_t at = 0) {
    const bool faulty = firing == fault.firing && column == fault.column;
    return cells[column].at(at) = faulty ? x + fault.more : x;
  }

  void take_array() {
    const auto format = [this](const char* key) { return format_of(keys.at(key)); };
    weight = format("weight"), bias = format("bias"), drive = format("drive");
    state = format("state"), link = format("link");
    lanes = std::stoi(keys.at("lanes")), reciprocal_bits = std::stoi(keys.at("reciprocal_bits"));
    most_taps = std::stoul(keys.at("taps"));
    if (keys.at("accumulator") != "exact") {
      sum = format("accumulator");
      return;
    }
    sum = Format{100, std::max(weight.fraction + link.fraction, bias.fraction), "SC_TRN", "SC_WRAP"};
  }

  Wide accumulate() {
    const std::size_t taps = static_cast<std::size_t>(cells["taps"][0]);
    const int product = weight.fraction + link.fraction, fine = std::max(product, sum.fraction);
    Wide s = put("sum", quantised(cells["bias"][0], 1, sum.fraction - bias.fraction, sum));
    for (std::size_t beat = 1; beat < cells["sum"].size(); ++beat) {
      const std::size_t first = (beat - 1) * static_cast<std::size_t>(lanes);
      Wide total = s * (Wide{1} << (fine - sum.fraction));
      for (std::size_t t = first; t < std::min(taps, first + static_cast<std::size_t>(lanes)); ++t)
        total += cells["weight"][t] * cells["link"][t] * (Wide{1} << (fine - product));
      s = put("sum", quantised(total, 1, sum.fraction - fine, sum), beat);
    }
    return s;
  }

  Wide norm() {
    if (keys.at("output") == "binary" || keys.at("normaliser") == "prescaled") return put("norm", 0);
    const int unit = std::max(weight.fraction, bias.fraction);
    Wide N = magnitude(cells["bias"][0]) << (unit - bias.fraction);
    for (Wide w : cells["weight"]) N += magnitude(w) << (unit - weight.fraction);
    return put("norm", N);
  }

  // u before the limiter.
  Wide ratio(Wide s, Wide N) {
    const Wide one = Wide{1} << drive.fraction;
    const int places = std::max(weight.fraction, bias.fraction) + drive.fraction - sum.fraction;
    put("reciprocal", 0), put("places", 0);
    if (keys.at("output") == "binary") return put("ratio", s > 0 ? one : s < 0 ? -one : 0);
    if (keys.at("normaliser") == "prescaled")
      return put("ratio", quantised(s, 1, drive.fraction - sum.fraction, drive));
    if (N <= 0) return put("ratio", 0);
    if (keys.at("normaliser") == "divider") return put("ratio", quantised(s, N, places, drive));
    int bits = 0;
    while (N >> bits != 0) ++bits;
    const int exponent = bits + reciprocal_bits - 2;
    const Wide r = put("reciprocal", (Wide{1} << exponent) / N);
    const Wide down = put("places", exponent - places);
    return put("ratio", quantised(s * r, 1, static_cast<int>(-down), drive));
  }

  void fire() {
    const Wide s = accumulate(), before = cells["state"][0];
    const Wide limit = Wide{1} << drive.fraction, one = Wide{1} << state.fraction;
    const Wide u = put("drive", std::min(std::max(ratio(s, norm()), -limit), limit));
    const Wide R = put("pull", u >= 0 ? one - before : one + before);
    const Wide product = put("product", R * u);
    const Wide change = put("change", rounded(product, Wide{1} << drive.fraction, state.rounding));
    const Wide after = put("state_after", before + change);
    put("link_after", quantised(after, 1, link.fraction - state.fraction, link));
    firing += 1;
  }
};

/// "weight_3" is cell 3 of column "weight"; "link_after" a column of its own.
std::string column_of(const std::string& heading) {
  const std::size_t end = heading.find_last_not_of("0123456789");
  return end + 1 < heading.size() && heading[end] == '_' ? heading.substr(0, end) : heading;
}

void answer(Neuron& neuron, const std::vector<std::string>& headings, std::istream& words,
            std::ostream& out) {
  neuron.cells.clear();
  std::string word, edges;
  for (const std::string& heading : headings) {
    words >> word;
    if (heading == "edges") edges = word;
    const bool number = word != "?" && heading != "edges";
    neuron.cells[column_of(heading)].push_back(number ? std::stoll(word) : 0);
  }
  neuron.fire();
  std::map<std::string, std::size_t> at;
  out << "fire";
  for (const std::string& heading : headings) {
    const std::string column = column_of(heading);
    const Wide cell = neuron.cells[column][at[column]++];
    out << ' ';
    if (heading == "edges")
      out << edges;
    else
      out << static_cast<long long>(cell);
  }
  out << '\n';
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 6)
    return std::cerr << "usage: other_neuron BLANK FILLED [FIRING COLUMN MORE]\n", 2;
  std::ifstream in(argv[1]);
  std::ofstream out(argv[2]);
  Neuron neuron;
  if (argc == 6) neuron.fault = {std::atol(argv[3]), argv[4], std::atol(argv[5])};
  std::vector<std::string> headings;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string key, word;
    words >> key;
    if (key == "fire") {
      answer(neuron, headings, words, out);
      continue;
    }
    out << line << '\n';
    if (key == "columns") {
      while (words >> word) headings.push_back(word);
      neuron.take_array();
    } else if (words >> word) {
      neuron.keys[key] = word;
    }
  }
  return out ? 0 : 1;
}
