#include "sim/study/size/size_search.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::study {

namespace {

class Search {
 public:
  Search(const Sizing& sizing, const SizeGoal& goal, SizeTrials& trials)
      : sizing_(sizing), goal_(goal), trials_(trials), most_sweeps_(goal.most_sweeps) {}

  SizeFound found() {
    found_.setting = sizing_.widest();
    found_.reached = lower(k_weight, k_threshold) && lower(k_threshold, k_lanes);
    if (!found_.reached) {
      found_.why =
          fmt::format("no array meets {} m: the nearest of {} tried, up to the widest there is, ends "
                      "{:.3g} m away",
                      goal_.error, found_.tried, found_.least_error);
      return found_;
    }
    found_.reached = choose_lanes();
    if (found_.reached) add_size();
    return found_;
  }

 private:
  std::string fails_by(const TrialRow& row) const {
    if (row.outcome != run::Outcome::finished) return std::string(name_of(row.outcome));
    if (row.error > goal_.error) return "error";
    return row.sweeps > most_sweeps_ ? "sweeps" : "";
  }

  /// Setting of the search over the knobs from `first` on -> the whole one.
  Setting whole(const Setting& part, std::size_t first) const {
    Setting setting = found_.setting;
    std::copy(part.begin(), part.end(), setting.begin() + static_cast<std::ptrdiff_t>(first));
    return setting;
  }
  static Setting part(const Setting& whole, std::size_t first, std::size_t end) {
    return {whole.begin() + static_cast<std::ptrdiff_t>(first),
            whole.begin() + static_cast<std::ptrdiff_t>(end)};
  }

  /// Formats cost silicon; sweeps cost themselves.
  double cost_of(const Setting& setting, const TrialRow& row, bool formats) const {
    return formats ? sizing_.silicon_bits(setting) : static_cast<double>(row.sweeps);
  }

  // The least levels of the knobs first .. end - 1, all others as they are.
  bool lower(std::size_t first, std::size_t end) {
    const bool formats = first == k_weight;
    LeastSetting search(
        end - first,
        [=](const Setting& from, std::size_t knob, int by) -> std::optional<Setting> {
          const auto lower = sizing_.lowered(whole(from, first), first + knob, by);
          return lower ? std::optional(part(*lower, first, end)) : std::nullopt;
        },
        [=](const std::vector<Setting>& parts) { return asked(parts, first, formats); });
    const auto least = search.from(begin_of(first, end), formats ? goal_.start_level : std::nullopt);
    if (formats) count(search, least);
    if (!least) return false;
    const Setting at = whole(*least, first);
    for (int by : {1, 2})
      for (std::size_t knob = first; knob < end; ++knob) add_less(at, knob, by);
    found_.setting = at;
    return true;
  }

  // Sweeps that no step ever made are free to go; a relaxation that takes more of them in all is no smaller.
  Setting begin_of(std::size_t first, std::size_t end) {
    Setting start = found_.setting;
    if (first == k_threshold) most_sweeps_ = trials_.row(start).sweeps;
    if (first == k_threshold)
      start[k_sweeps] = std::clamp(static_cast<int>(trials_.row(start).most_sweeps), 1, start[k_sweeps]);
    return part(start, first, end);
  }

  std::vector<Trial> asked(const std::vector<Setting>& parts, std::size_t first, bool formats) {
    std::vector<Setting> settings;
    for (const Setting& p : parts) settings.push_back(whole(p, first));
    std::vector<Trial> answers;
    const std::vector<TrialRow> rows = trials_.rows(settings);
    for (std::size_t k = 0; k < rows.size(); ++k)
      answers.push_back({fails_by(rows[k]).empty(), rows[k].error, cost_of(settings[k], rows[k], formats)});
    return answers;
  }

  void count(const LeastSetting& search, const std::optional<Setting>& least) {
    found_.tried = search.seen().size();
    found_.least_error = HUGE_VAL;
    for (const auto& [setting, trial] : search.seen()) {
      found_.least_error = std::min(found_.least_error, trial.error);
      found_.met += trial.passes;
      found_.cheaper += least && trial.passes && trial.cost < search.trial(*least).cost;
    }
  }

  void add(const std::string& what, const std::string& knob, const Setting& setting) {
    const TrialRow row = trials_.row(setting);
    found_.evidence.push_back({what, knob, setting, row, fails_by(row)});
  }

  void add_less(const Setting& at, std::size_t knob, int by) {
    if (const auto less = sizing_.lowered(at, knob, by))
      add(by == 1 ? "one less" : "two less", knob_names[knob], *less);
  }

  double seconds(const TrialRow& row) const {
    return static_cast<double>(row.most_cycles) / (goal_.clock_mhz * 1e6);
  }

  /// Numbers of lanes with which the longest row takes fewer cycles than with one lane less.
  std::vector<Setting> lane_settings() const {
    std::vector<Setting> settings;
    std::size_t before = 0;
    for (std::size_t lanes = 1; lanes <= std::min<std::size_t>(64, goal_.most_taps); ++lanes) {
      const std::size_t cycles = (goal_.most_taps + lanes - 1) / lanes;
      if (cycles == before) continue;
      before = cycles;
      settings.push_back(found_.setting);
      settings.back()[k_lanes] = static_cast<int>(lanes);
    }
    return settings;
  }

  // Lanes change cycles of the array, neither bits nor the bus. Unasked: the least product of silicon and the
  // cycles of both.
  bool choose_lanes() {
    const std::vector<Setting> settings = lane_settings();
    const std::vector<TrialRow> rows = trials_.rows(settings);
    std::optional<std::size_t> best;
    const auto product = [&](std::size_t k) {
      return sizing_.silicon_bits(settings[k]) * static_cast<double>(rows[k].cycles + rows[k].bus_cycles);
    };
    for (std::size_t k = 0; k < settings.size(); ++k) {
      const bool fits = goal_.time_per_step == 0 || seconds(rows[k]) <= goal_.time_per_step;
      const bool better = !best || (goal_.time_per_step == 0 && product(k) < product(*best));
      if (fits && better) best = k;
      found_.evidence.push_back({"lanes", knob_names[k_lanes], settings[k], rows[k], fits ? "" : "time"});
    }
    if (best) found_.setting = settings[*best];
    if (!best)
      found_.why =
          fmt::format("no number of lanes does a step in {} s: {} of them take {:.3g} s for the slowest",
                      goal_.time_per_step, settings.back()[k_lanes], seconds(rows.back()));
    return best.has_value();
  }

  void add_size() {
    const Setting scenes = sizing_.widest();
    found_.file = found_.setting;
    for (std::size_t knob : {k_threshold, k_sweeps}) found_.file[knob] = scenes[knob];
    std::vector<SizeEvidence> rest = std::move(found_.evidence);
    found_.evidence.clear();
    add("size", "", found_.setting);
    add("array file", "", found_.file);
    found_.evidence.insert(found_.evidence.end(), rest.begin(), rest.end());
  }

  const Sizing& sizing_;
  const SizeGoal& goal_;
  SizeTrials& trials_;
  std::uint64_t most_sweeps_;
  SizeFound found_;
};

} // namespace

SizeFound find_size(const Sizing& sizing, const SizeGoal& goal, SizeTrials& trials) {
  return Search(sizing, goal, trials).found();
}

} // namespace hopmesh::study
