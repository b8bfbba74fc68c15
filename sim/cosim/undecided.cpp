#include "sim/cosim/undecided.h"

#include "sim/input/count_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::cosim {

bool is_undecided(const levels::StepRow& row) {
  return row.error && row.error->largest_output > far_output &&
         std::fabs(row.error->energy_gap) <= equal_energy;
}

std::string undecided_text(const run::StepRows& rows) {
  std::uint64_t count = 0, first = 0, last = 0;
  double others = 0, gap = 0;
  for (const levels::StepRow& row : rows) {
    if (!is_undecided(row)) {
      if (row.error) others = std::max(others, row.error->largest_output);
      continue;
    }
    if (count++ == 0) first = row.step;
    last = row.step;
    gap = std::max(gap, std::fabs(row.error->energy_gap));
  }
  if (count == 0) return "";
  std::string text = fmt::format(
      "    {} of {} (first {}, last {}) leave outputs undecided: they differ by more than {}, yet energies\n"
      "    agree to {:.1g} of the fall, so either answer is as good (a flat mesh may leave its plane to "
      "either "
      "side)\n",
      input::grouped(count), input::with_noun(rows.size(), "step"), first, last, far_output, gap);
  if (count < rows.size())
    text += fmt::format("    in all other steps outputs differ by at most {:.3g}\n", others);
  return text;
}

} // namespace hopmesh::cosim
