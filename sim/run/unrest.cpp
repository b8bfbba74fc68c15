#include "sim/run/unrest.h"

#include "sim/input/count_text.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::run {

namespace {

// Not with judgement of the run as a whole: a rival's steps are no relaxation.
bool is_relaxation(const levels::StepRow& row) {
  return row.sweeps > 0;
}

bool leaves_much(const levels::StepRow& row) {
  return row.fall_left && *row.fall_left > most_fall_left;
}

template <class Holds> std::uint64_t count_if(const StepRows& rows, Holds holds) {
  return static_cast<std::uint64_t>(std::count_if(rows.begin(), rows.end(), holds));
}

std::string most_left(const StepRows& rows) {
  return fmt::format("up to {:.2g} % of their fall",
                     100 * total_of(rows, &levels::StepRow::fall_left, levels::Summary::largest));
}

} // namespace

bool is_unrested(const levels::StepRow& row) {
  return is_relaxation(row) && (!row.converged || leaves_much(row));
}

std::string unrest_text(const StepRows& rows) {
  if (count_if(rows, is_unrested) == 0) return "";
  const std::uint64_t stopped = count_if(rows, [](const levels::StepRow&r) { return !r.converged; }),
                      left = count_if(rows, leaves_much);
  std::string text = fmt::format("{} of {} did not come to rest", input::grouped(count_if(rows, is_unrested)),
                                 input::with_noun(rows.size(), "step"));
  if (stopped > 0) text += fmt::format(": {} stopped by max_sweeps", input::grouped(stopped));
  if (left > 0)
    text += fmt::format("{} {} left {}", stopped > 0 ? "," : ":", input::grouped(left), most_left(rows));
  return text + ".";
}

} // namespace hopmesh::run
