#include "sim/run/unrest.h"

#include "sim/input/count_text.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::run {

namespace {

/// A way in which a step is not at rest. Another reason is another line of `reasons`.
struct Reason {
  bool (*holds)(const levels::StepRow& row);
  const char* words; ///< what its steps did
};

// A rival's steps are no relaxation: they have no sweeps.
bool ended_at_limit(const levels::StepRow& row) {
  return row.sweeps > 0 && !row.converged;
}

// Whatever ended it. Known only where somebody looked for the rest.
bool leaves_much(const levels::StepRow& row) {
  return row.sweeps > 0 && row.fall_left && *row.fall_left > most_fall_left;
}

constexpr Reason reasons[] = {{ended_at_limit, "ended at max_sweeps"},
                              {leaves_much, "left more than a tenth of their fall"}};

} // namespace

bool is_unrested(const levels::StepRow& row) {
  return std::any_of(std::begin(reasons), std::end(reasons), [&](const Reason& r) { return r.holds(row); });
}

std::string unrest_text(const StepRows& rows) {
  std::string text;
  for (const Reason& reason : reasons)
    if (const auto count = std::count_if(rows.begin(), rows.end(), reason.holds); count > 0)
      text += fmt::format("{}{} of {} {}", text.empty() ? "" : ", ",
                          input::grouped(static_cast<std::uint64_t>(count)),
                          input::with_noun(rows.size(), "step"), reason.words);
  return text.empty() ? text : text + ".";
}

} // namespace hopmesh::run
