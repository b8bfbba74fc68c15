// Output stages and normalisers as a test walks them.
#pragma once

#include "rtl_model/spec/array_rules.h"
#include "rtl_model/spec/presets.h"

#include <tuple>

namespace hopmesh::tests {

/// What makes V of a sum: a row of the table of cycles.
struct StageKind {
  const char* name;
  spec::Output output;
  spec::Normaliser normaliser;
};
inline constexpr std::array<StageKind, 8> stage_kinds{
    {{"prescaled", spec::Output::modified, spec::Normaliser::prescaled},
     {"reciprocal", spec::Output::modified, spec::Normaliser::reciprocal},
     {"divider", spec::Output::modified, spec::Normaliser::divider},
     {"binary", spec::Output::binary, spec::Normaliser::divider},
     {"projected", spec::Output::projected, spec::Normaliser::reciprocal},
     {"projected_divider", spec::Output::projected, spec::Normaliser::divider},
     {"momentum", spec::Output::momentum, spec::Normaliser::reciprocal},
     {"momentum_divider", spec::Output::momentum, spec::Normaliser::divider}}};

/// The default array with such a stage.
inline spec::ArraySpec array_with(const StageKind& kind, spec::Schedule schedule) {
  spec::ArraySpec array = spec::guarded_array();
  array.schedule = schedule;
  array.output = kind.output;
  array.normaliser = kind.normaliser;
  array.momentum_entries = 3;
  return array;
}

/// Numbers of schedules and stages that go together.
inline std::vector<std::tuple<int, int>> schedules_and_stages() {
  std::vector<std::tuple<int, int>> all;
  for (int schedule = 0; schedule < 3; ++schedule)
    for (std::size_t k = 0; k < stage_kinds.size(); ++k)
      if (!spec::validate(array_with(stage_kinds[k], static_cast<spec::Schedule>(schedule)), 27))
        all.emplace_back(schedule, static_cast<int>(k));
  return all;
}

} // namespace hopmesh::tests
