#include "sim/cosim/firings/firing_judge.h"

#include "sim/cosim/firings/firing_edges.h"
#include "sim/levels/interrupt.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cosim {

namespace {

bool tells(const std::vector<Cell>& cells) {
  return std::all_of(cells.begin(), cells.end(), [](const Cell& cell) { return cell.has_value(); });
}

/// The first cell that a core told otherwise.
struct WrongCell {
  std::size_t column, at;
};

std::optional<WrongCell> first_wrong(const FiringRow& found, const FiringRow& right) {
  for (std::size_t c = 0; c < found.size(); ++c)
    for (std::size_t k = 0; k < found[c].size(); ++k)
      if (firing_columns()[c].part == Part::answer && found[c][k] && *found[c][k] != *right[c][k])
        return WrongCell{c, k};
  return std::nullopt;
}

std::string cell_name(const WrongCell& w) {
  const FiringColumn& column = firing_columns()[w.column];
  if (column.count == Count::one) return column.name;
  return fmt::format("{}_{}, {}", column.name, w.at,
                     w.at == 0 ? "as the bias leaves it" : fmt::format("after beat {}", w.at));
}

std::string source_of(const Firing& f) {
  if (f.sweep == 0) return fmt::format("firing {}", f.neuron);
  return fmt::format("firing of neuron {} in sweep {}", f.neuron, f.sweep);
}

/// What was right and told before the first wrong cell.
std::string right_before(const WrongCell& wrong, const FiringRow& found) {
  std::vector<std::string> stages;
  for (std::size_t c = 0; c < wrong.column; ++c) {
    const std::string stage = firing_columns()[c].stage;
    if (firing_columns()[c].part == Part::answer && tells(found[c]) &&
        (stages.empty() || stages.back() != stage) && stage != firing_columns()[wrong.column].stage)
      stages.push_back(stage);
  }
  return stages.empty() ? "nothing" : fmt::format("{}", fmt::join(stages, ", "));
}

std::string rights_text(const FiringRow& right) {
  std::string text;
  for (std::size_t c = 0; c < right.size(); ++c) {
    if (firing_columns()[c].part != Part::answer) continue;
    text += fmt::format(" {} {}", firing_columns()[c].name, *right[c].back());
  }
  return text;
}

/// Y and m, where there are any.
std::string ahead_text(const spec::FiringInputs& in) {
  if (in.extrapolated == 0 && in.momentum == 0) return "";
  return fmt::format("Y before {}, m {}, ", in.extrapolated, in.momentum);
}

std::string wrong_text(const std::string& place, const Firing& f, const FiringRow& found,
                       const FiringRow& right, const WrongCell& w) {
  const std::int64_t is = *found[w.column][w.at], should = *right[w.column][w.at];
  const __int128 off = static_cast<__int128>(is) - should;
  const auto size = static_cast<std::uint64_t>(off < 0 ? -off : off);
  std::string text =
      fmt::format("{}: {}: {} is wrong first ({}): found {}, expected {}: {} last place{} too {}\n", place,
                  source_of(f), firing_columns()[w.column].stage, cell_name(w), is, should, size,
                  size == 1 ? "" : "s", off > 0 ? "high" : "low");
  text += fmt::format("  right before it: {}; edges: {}\n", right_before(w, found), edge_names(f.edges));
  text +=
      fmt::format("  V before {}, {}bias {}; weights {}; links {}\n", f.inputs.state, ahead_text(f.inputs),
                  f.inputs.bias, fmt::join(f.inputs.weight, " "), fmt::join(f.inputs.link, " "));
  return text + "  right is:" + rights_text(right);
}

/// Which stages a line leaves out, over all lines.
class Told {
 public:
  void note(const FiringRow& row, const FiringReader& reader) {
    bool any = false;
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (firing_columns()[c].part != Part::answer) continue;
      const bool told = tells(row[c]);
      left_out_[c] = left_out_[c] || !told;
      any = any || told;
    }
    if (!any) reader.fail("no answer", "answers: this line was not filled in");
  }

  void report(FiringsJudged& judged) const {
    for (std::size_t c = 0; c < left_out_.size(); ++c) {
      const FiringColumn& column = firing_columns()[c];
      if (column.part != Part::answer) continue;
      auto& names = left_out_[c] ? judged.untold : judged.told;
      if (names.empty() || names.back() != column.stage) names.push_back(column.stage);
    }
  }

 private:
  std::vector<bool> left_out_ = std::vector<bool>(firing_columns().size(), false);
};

} // namespace

FiringsJudged judge_firings(const std::string& path, const levels::Level& level) {
  const auto reader = open_firings(path);
  const NeuronShape& shape = reader->shape();
  const levels::OpenNeuron neuron = level.open_neuron(shape.array, shape.taps);
  FiringsJudged judged;
  Told told;
  for (FiringRow row; judged.wrong.empty() && reader->next(row);) {
    judged.interrupted = levels::stop_requested;
    if (judged.interrupted) return judged;
    if (const auto fault = row_fault(row, shape)) reader->fail(fault->first, fault->second);
    told.note(row, *reader);
    Firing f = firing_of(row);
    f.steps = neuron(f.inputs);
    const FiringRow right = row_of(f, shape);
    if (const auto wrong = first_wrong(row, right))
      judged.wrong = wrong_text(reader->place(), f, row, right, *wrong);
    else
      judged.firings += 1;
  }
  if (judged.wrong.empty() && judged.firings == 0) reader->fail("no firing", "at least one");
  told.report(judged);
  return judged;
}

} // namespace hopmesh::cosim
