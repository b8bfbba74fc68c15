// Lines of answers, as a core filled them in.
#include "sim/cosim/vectors.h"
#include "sim/input/input_error.h"

#include <fmt/format.h>

namespace hopmesh::cosim {

using input::in_quotes;

namespace {

constexpr const char* end_shape = "end SWEEPS CONVERGED LARGEST_CHANGE LARGEST_SUM CYCLES";

} // namespace

AnswerLine VectorReader::answer() {
  constexpr std::int64_t most_cycles = std::int64_t{1} << 53;
  const std::string fire =
      fmt::format("fire {} {} CYCLE and {} outputs", next_sweep_, next_phase_, phases_[next_phase_].size());
  const std::string shape = next_phase_ > 0 || next_sweep_ == 1 ? fire : fire + ", or " + end_shape;
  if (!lines_.read()) lines_.fail("the end of the file", shape);
  const Words w = lines_.split();
  if (w[0] == "?") lines_.fail("?", "answers: this case was not filled in");
  AnswerLine a;
  a.line = lines_.line();
  a.end = w[0] == "end" && next_phase_ == 0 && next_sweep_ > 1;
  if (a.end) {
    if (w.size() != 6) lines_.fail(in_quotes(lines_.text()), end_shape);
    a.run = {static_cast<std::uint32_t>(lines_.number(w[1], 0, UINT32_MAX, "sweeps")),
             lines_.number(w[2], 0, 1, "converged") == 1,
             static_cast<std::uint32_t>(lines_.number(w[3], 0, UINT32_MAX, "the largest change")),
             static_cast<std::uint64_t>(lines_.number(w[5], 0, most_cycles, "cycles")),
             static_cast<std::uint64_t>(lines_.number(w[4], 0, INT64_MAX, "the largest sum"))};
    in_answers_ = false;
    return a;
  }
  if (w[0] != "fire")
    lines_.fail(in_quotes(lines_.text()), shape, input::nearest_name(w[0], {"fire", "end"}));
  if (w.size() != 4 + phases_[next_phase_].size() || w[1] != std::to_string(next_sweep_) ||
      w[2] != std::to_string(next_phase_))
    lines_.fail(in_quotes(lines_.text()), shape);
  a.sweep = next_sweep_, a.phase = next_phase_;
  a.cycle = static_cast<std::uint64_t>(lines_.number(w[3], 0, most_cycles, "a cycle"));
  for (std::size_t k = 4; k < w.size(); ++k) a.codes.push_back(code(w[k]));
  if (++next_phase_ == phases_.size()) next_phase_ = 0, next_sweep_ += 1;
  return a;
}

void VectorReader::skip_answers() {
  while (in_answers_) {
    if (!lines_.read()) lines_.fail("the end of the file", "end of the answers");
    const std::string word = lines_.split()[0];
    in_answers_ = word != "end" && word != "?";
  }
}

} // namespace hopmesh::cosim
