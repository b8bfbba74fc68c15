// How a motion ended. The word stands in manifests, statistics and the results of studies.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace hopmesh::run {

enum class Outcome {
  finished,
  interrupted, ///< by the user
  diverged,
  crashed, ///< its process died
  failed   ///< it could not be tried
};
inline constexpr std::array<std::string_view, 5> outcome_names{"finished", "interrupted", "diverged",
                                                               "crashed", "failed"};

inline std::string_view name_of(Outcome outcome) {
  return outcome_names[static_cast<std::size_t>(outcome)];
}

inline std::optional<Outcome> outcome_named(std::string_view name) {
  for (std::size_t k = 0; k < outcome_names.size(); ++k)
    if (outcome_names[k] == name) return static_cast<Outcome>(k);
  return std::nullopt;
}

} // namespace hopmesh::run
