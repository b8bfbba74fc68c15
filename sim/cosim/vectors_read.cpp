// Text -> jobs and answers. Every line has one place; what stands there instead is told with its number.
#include "sim/cosim/vectors.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/input/input_error.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cosim {

using input::in_quotes;

VectorReader::VectorReader(const std::string& path, spec::ArrayTable table)
    : lines_(path, {vectors_header}, "a file of test vectors"), table_(table) {}

std::int32_t VectorReader::code(const std::string& word) const {
  return static_cast<std::int32_t>(lines_.number(word, INT32_MIN, INT32_MAX, "a raw code"));
}

bool VectorReader::next(VectorCase& a_case) {
  skip_answers();
  if (!lines_.read()) return false;
  const Words words = lines_.split();
  const std::string& text = lines_.text();
  if (words[0] != "case" || words.size() < 2)
    lines_.fail(in_quotes(text), "case NAME", input::nearest_name(words[0], {"case"}));
  a_case.name = text.substr(text.find(words[1], text.find("case") + 4));
  ArrayJob job;
  lines_.read_array(job.array, table_);
  read_links(job.topology);
  lines_.check_rules(job.array, job.topology.most_taps(), table_);
  job.threshold = static_cast<std::uint32_t>(lines_.expect_number("threshold", 0, UINT32_MAX));
  job.max_sweeps = static_cast<std::uint32_t>(lines_.expect_number("max_sweeps", 0, UINT32_MAX));
  read_stop(job);
  read_momentum(job);
  read_neurons(job);
  read_phases(job);
  if (!lines_.expect("answers", "answers").empty()) lines_.fail(in_quotes(lines_.text()), "answers");
  in_answers_ = true;
  next_sweep_ = 1, next_phase_ = 0;
  a_case.job = std::move(job);
  return true;
}

// ---- the network ----

void VectorReader::read_links(spec::Topology& t) {
  const std::int64_t cells = lines_.expect_number("cells", 1, spec::most_cells);
  t.neurons_per_cell = static_cast<int>(lines_.expect_number("neurons_per_cell", 1, 3));
  t.first_link = {0};
  std::vector<int> lines;
  for (std::int64_t c = 0; c < cells; ++c) {
    const std::string shape = fmt::format("links {} and its neighbours, ascending", c);
    const Words w = lines_.expect("links", shape);
    if (w.empty() || w[0] != std::to_string(c)) lines_.fail(in_quotes(lines_.text()), shape);
    lines.push_back(lines_.line());
    std::int64_t least = 0;
    for (std::size_t k = 1; k < w.size(); ++k) {
      const std::int64_t other = lines_.number(w[k], least, cells - 1, "a neighbour in ascending order");
      if (other == c) lines_.fail(in_quotes(w[k]), "another cell");
      t.link_to.push_back(static_cast<std::uint32_t>(other));
      least = other + 1;
    }
    t.first_link.push_back(static_cast<std::uint32_t>(t.link_to.size()));
  }
  check_links(t, lines);
}

// Links lead both ways.
void VectorReader::check_links(const spec::Topology& t, const std::vector<int>& lines) const {
  const auto begin = t.link_to.begin();
  for (std::size_t c = 0; c < t.cells(); ++c)
    for (std::size_t k = t.first_link[c]; k < t.first_link[c + 1]; ++k) {
      const std::uint32_t other = t.link_to[k];
      if (std::binary_search(begin + t.first_link[other], begin + t.first_link[other + 1], c)) continue;
      throw input::input_error(lines_.path(), lines[c], "links",
                               fmt::format("cell {} linked to {}", c, other),
                               fmt::format("{} among the neighbours of {} too", c, other));
    }
}

void VectorReader::read_stop(ArrayJob& job) {
  const std::string shape = "stop change or stop sum";
  const Words w = lines_.expect("stop", shape);
  if (w.size() != 1 || (w[0] != "change" && w[0] != "sum")) lines_.fail(in_quotes(lines_.text()), shape);
  job.rule.by_sum = w[0] == "sum";
  job.rule.share = static_cast<int>(lines_.expect_number("share", 0, most_share));
  job.rule.floor = static_cast<std::uint64_t>(lines_.expect_number("sum_threshold", 0, INT64_MAX));
}

void VectorReader::read_momentum(ArrayJob& job) {
  const std::size_t entries = table_entries(job.array);
  const std::string shape = fmt::format("momentum and {} codes", entries);
  const Words w = lines_.expect("momentum", shape);
  if (w.size() != entries) lines_.fail(fmt::format("{} words behind \"momentum\"", w.size()), shape);
  for (const std::string& word : w) job.momentum.push_back(code(word));
}

void VectorReader::read_neurons(ArrayJob& job) {
  const spec::Topology& t = job.topology;
  for (std::size_t i = 0; i < t.neurons(); ++i) {
    const std::size_t taps = t.taps(i / static_cast<std::size_t>(t.neurons_per_cell));
    const std::string shape = fmt::format("neuron {}, start, bias and {} weights", i, taps);
    const Words w = lines_.expect("neuron", shape);
    if (w.size() != 3 + taps) lines_.fail(fmt::format("{} words behind \"neuron\"", w.size()), shape);
    if (w[0] != std::to_string(i)) lines_.fail("neuron " + in_quotes(w[0]), shape);
    job.start.push_back(code(w[1]));
    job.bias.push_back(code(w[2]));
    for (std::size_t tap = 0; tap < taps; ++tap) job.weight.push_back(code(w[3 + tap]));
  }
}

// What the schedule says anyway; a file that says otherwise would be filled in wrongly.
void VectorReader::read_phases(const ArrayJob& job) {
  phases_ = spec::phases_of(job.topology, job.array.schedule);
  const auto count = lines_.expect("phases", "phases N");
  if (count.size() != 1 || count[0] != std::to_string(phases_.size()))
    lines_.fail(in_quotes(lines_.text()), fmt::format("phases {} by the schedule", phases_.size()));
  for (std::size_t k = 0; k < phases_.size(); ++k) {
    const auto w = lines_.expect("phase", fmt::format("phase {} and its neurons", k));
    bool same = w.size() == 1 + phases_[k].size() && w[0] == std::to_string(k);
    for (std::size_t n = 0; same && n < phases_[k].size(); ++n)
      same = w[1 + n] == std::to_string(phases_[k][n]);
    if (same) continue;
    const std::string all = fmt::format("phase {} {}", k, fmt::join(phases_[k], " "));
    lines_.fail(in_quotes(lines_.text()),
                (all.size() > 100 ? all.substr(0, 100) + "..." : all) + " by the schedule");
  }
}

} // namespace hopmesh::cosim
