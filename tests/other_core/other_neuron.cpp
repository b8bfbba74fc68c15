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

  bool is(const char* output) const { return keys.at("output") == output; }
  bool steps() const { return is("projected") || is("momentum"); }

  Wide norm() {
    if (is("binary") || keys.at("normaliser") == "prescaled") return put("norm", 0);
    const int unit = std::max(weight.fraction, bias.fraction);
    const auto in_units = [&](Wide w) { return magnitude(w) << (unit - weight.fraction); };
    if (is("projected"))
      return put("norm", in_units(cells["weight"].at(static_cast<std::size_t>(cells["own"][0]))));
    Wide N = is("momentum") ? 0 : magnitude(cells["bias"][0]) << (unit - bias.fraction);
    for (Wide w : cells["weight"]) N += in_units(w);
    return put("norm", N);
  }

  Wide far() const { return (Wide{1} << drive.fraction) * (is("projected") ? 2 : 1); }
  static Wide within(Wide x, Wide most) { return std::min(std::max(x, -most), most); }

  // a / b * 2^places, with omega where there is one: a code of the drive, or held before it is one.
  Wide drive_code(Wide a, Wide b, int places) const {
    if (!steps()) return quantised(a, b, places, drive);
    if (is("projected")) a *= std::stoi(keys.at("relaxation")), b *= 16;
    return within(scaled(a, b, places, drive.rounding), far());
  }

  // u before the limiter.
  Wide ratio(Wide s, Wide N) {
    const int places = std::max(weight.fraction, bias.fraction) + drive.fraction - sum.fraction;
    put("reciprocal", 0), put("places", 0);
    if (is("binary") || (steps() && N <= 0)) return put("ratio", s > 0 ? far() : s < 0 ? -far() : 0);
    if (keys.at("normaliser") == "prescaled")
      return put("ratio", quantised(s, 1, drive.fraction - sum.fraction, drive));
    if (N <= 0) return put("ratio", 0);
    if (keys.at("normaliser") == "divider") return put("ratio", drive_code(s, N, places));
    int bits = 0;
    while (N >> bits != 0) ++bits;
    const int exponent = bits + reciprocal_bits - 2;
    const Wide r = put("reciprocal", (Wide{1} << exponent) / N);
    const Wide down = put("places", exponent - places);
    return put("ratio", drive_code(s * r, 1, static_cast<int>(-down)));
  }

  // A step by u itself, from V or from Y.
  Wide step(Wide from, Wide u) const {
    return within(from + scaled(u, 1, state.fraction - drive.fraction, state.rounding),
                  Wide{1} << state.fraction);
  }

  void fire() {
    const Wide s = accumulate(), before = cells["state"][0];
    const Wide u = put("drive", within(ratio(s, norm()), far()));
    put("pull", 0), put("product", 0), put("extrapolated_after", 0);
    if (is("momentum"))
      look_ahead(before, step(cells["extrapolated"][0], u));
    else if (is("projected"))
      show(put("state_after", before + put("change", step(before, u) - before)));
    else
      show(put("state_after", before + put("change", pulled(before, u))));
    firing += 1;
  }

  Wide pulled(Wide before, Wide u) {
    const Wide one = Wide{1} << state.fraction, R = put("pull", u >= 0 ? one - before : one + before);
    return rounded(put("product", R * u), Wide{1} << drive.fraction, state.rounding);
  }

  void look_ahead(Wide before, Wide to) {
    const Wide change = put("change", to - before), after = put("state_after", before + change);
    const Wide product = put("product", cells["momentum"][0] * change);
    show(put("extrapolated_after",
             within(after + rounded(product, Wide{1} << 15, state.rounding), Wide{1} << state.fraction)));
  }

  void show(Wide x) { put("link_after", quantised(x, 1, link.fraction - state.fraction, link)); }
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
