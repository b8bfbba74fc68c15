// Search for the least setting of a few whole-numbered knobs that still passes a test which takes time, can
// be asked about several settings at once, and need not be monotone: less may pass by luck where more fails.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace hopmesh::study {

using Setting = std::vector<int>; ///< a level a knob; fewer is less

struct Trial {
  bool passes = false;
  double error = 0, cost = 0; ///< cost only chooses among settings that pass
};

class LeastSetting {
 public:
  /// Trials of settings in their order; each is asked for once. May throw to end the search.
  using Oracle = std::function<std::vector<Trial>(const std::vector<Setting>&)>;
  /// The setting with a knob lowered by so much, and whatever must follow it; none where it cannot be.
  using Lowered = std::function<std::optional<Setting>(const Setting&, std::size_t knob, int by)>;

  LeastSetting(std::size_t knobs, Lowered lowered, Oracle oracle)
      : knobs_(knobs), lowered_(std::move(lowered)), oracle_(std::move(oracle)) {}

  /// From a setting that should pass: all knobs together as low as they go, then knob by knob, each time the
  /// one that saves most for the error it adds, in strides that double where they pass and halve where they
  /// do not. What passes at two less though not at one less, or was seen to pass at less cost, is gone on
  /// from. None where neither `start` nor any cut of it passes. `guess`: the level down to which all knobs
  /// are cut first, and where that passes, nothing wider is tried.
  std::optional<Setting> from(const Setting& start, std::optional<int> guess = {});

  const Trial& trial(const Setting& setting) const { return seen_.at(setting); }
  const std::map<Setting, Trial>& seen() const { return seen_; }

 private:
  const Trial& ask(const Setting& setting);
  void ask_all(const std::vector<Setting>& settings);
  Setting cut_to(const Setting& start, int level) const;
  std::optional<Setting> start_of(const Setting& start, std::optional<int> guess);
  Setting halved(const Setting& start, int passes, int fails);
  Setting walked_down(const Setting& start, int level);
  std::optional<Setting> next(const Setting& at, int by);
  Setting descended(Setting at, int stride);
  std::optional<Setting> cheaper_than(const Setting& at, const std::vector<Setting>& tried) const;

  const std::size_t knobs_;
  const Lowered lowered_;
  const Oracle oracle_;
  std::map<Setting, Trial> seen_;
};

} // namespace hopmesh::study
