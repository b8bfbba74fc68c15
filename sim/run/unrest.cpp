#include "sim/run/unrest.h"

#include "sim/input/count_text.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::run {

namespace {

/// A way in which a step is not at rest. Another reason is another line of `reasons`.
struct Reason {
  bool (*known)(const levels::StepRow& row); ///< somebody looked
  bool (*holds)(const levels::StepRow& row);
  const char* words; ///< what its steps did
};

// A rival's steps are no relaxation: they have no sweeps.
bool ended_at_limit(const levels::StepRow& row) {
  return row.sweeps > 0 && !row.converged;
}

// Where nobody looked for the rest itself, what the host saw on the way there stands for it: at least so much
// is left.
const std::optional<double>& left_by(const levels::StepRow& row) {
  return row.fall_left ? row.fall_left : row.fall_seen;
}

// Whatever ended it.
bool leaves_much(const levels::StepRow& row) {
  return row.sweeps > 0 && left_by(row) && *left_by(row) > most_fall_left;
}

constexpr Reason reasons[] = {
    {[](const levels::StepRow&) { return true; }, ended_at_limit, "ended at max_sweeps"},
    {[](const levels::StepRow& row) { return left_by(row).has_value(); }, leaves_much,
     "left more than a tenth of their fall"}};

// Of how many steps this is known.
std::string among(std::uint64_t known, std::uint64_t steps) {
  return known == steps ? input::with_noun(steps, "step") : input::with_noun(known, "step") + " looked at";
}

} // namespace

bool is_unrested(const levels::StepRow& row) {
  return std::any_of(std::begin(reasons), std::end(reasons), [&](const Reason& r) { return r.holds(row); });
}

void UnrestCount::add(const levels::StepRow& row) {
  static_assert(std::size(reasons) == std::tuple_size_v<decltype(of)>);
  for (std::size_t k = 0; k < of.size(); ++k) {
    known[k] += reasons[k].known(row);
    of[k] += reasons[k].holds(row);
  }
  unrested += is_unrested(row);
  ++steps;
}

std::string UnrestCount::text() const {
  std::string text;
  for (std::size_t k = 0; k < of.size(); ++k)
    if (of[k] > 0)
      text += fmt::format("{}{} of {} {}", text.empty() ? "" : ", ", input::grouped(of[k]),
                          among(known[k], steps), reasons[k].words);
  return text.empty() ? text : text + ".";
}

std::string unrest_text(const StepRows& rows) {
  UnrestCount count;
  for (const levels::StepRow& row : rows) count.add(row);
  return count.text();
}

} // namespace hopmesh::run
