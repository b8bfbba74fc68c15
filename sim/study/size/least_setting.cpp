#include "sim/study/size/least_setting.h"

#include <algorithm>

namespace hopmesh::study {

namespace {

/// Does `a` save more for the error it adds than `b`, both one move from `now`? What adds none comes first.
bool better_move(const Trial& a, const Trial& b, const Trial& now) {
  const double added_a = a.error - now.error, added_b = b.error - now.error;
  const double saved_a = now.cost - a.cost, saved_b = now.cost - b.cost;
  if (added_a <= 0 || added_b <= 0) return added_b > 0 || (added_a <= 0 && saved_a > saved_b);
  return saved_a * added_b > saved_b * added_a;
}

} // namespace

void LeastSetting::ask_all(const std::vector<Setting>& settings) {
  std::vector<Setting> fresh;
  for (const Setting& s : settings)
    if (!seen_.count(s) && std::find(fresh.begin(), fresh.end(), s) == fresh.end()) fresh.push_back(s);
  if (fresh.empty()) return;
  const std::vector<Trial> trials = oracle_(fresh);
  for (std::size_t k = 0; k < fresh.size(); ++k) seen_[fresh[k]] = trials.at(k);
}

const Trial& LeastSetting::ask(const Setting& setting) {
  ask_all({setting});
  return seen_.at(setting);
}

// Every knob above the level is lowered to it, as far as it goes.
Setting LeastSetting::cut_to(const Setting& start, int level) const {
  Setting cut = start;
  for (std::size_t knob = 0; knob < knobs_; ++knob)
    while (cut[knob] > level) {
      const auto lower = lowered_(cut, knob, 1);
      if (!lower) break;
      cut = *lower;
    }
  return cut;
}

// Halving keeps a cut that passes above one that fails.
Setting LeastSetting::halved(const Setting& start, int passes, int fails) {
  while (passes - fails > 1) {
    const int middle = (passes + fails) / 2;
    (ask(cut_to(start, middle)).passes ? passes : fails) = middle;
  }
  return cut_to(start, passes);
}

// A good guess is a few levels above the least: level by level, past a single failure, as luck is not
// monotone.
Setting LeastSetting::walked_down(const Setting& start, int level) {
  int least = level;
  for (int failed = 0; level > 1 && failed < 2;) {
    const bool passes = ask(cut_to(start, --level)).passes;
    failed = passes ? 0 : failed + 1;
    if (passes) least = level;
  }
  return cut_to(start, least);
}

// Where even the start fails, luck may still lie below.
std::optional<Setting> LeastSetting::start_of(const Setting& start, std::optional<int> guess) {
  const int top = *std::max_element(start.begin(), start.begin() + static_cast<std::ptrdiff_t>(knobs_));
  const bool good = guess && *guess < top && ask(cut_to(start, *guess)).passes;
  if (!good && !ask(start).passes) {
    std::vector<Setting> cuts;
    for (int level = top - 2; level > 0; level -= 2) cuts.push_back(cut_to(start, level));
    ask_all(cuts);
    for (std::size_t k = cuts.size(); k-- > 0;)
      if (trial(cuts[k]).passes) return cuts[k];
    return std::nullopt;
  }
  if (ask(cut_to(start, 0)).passes) return cut_to(start, 0);
  if (good) return walked_down(start, *guess);
  return halved(start, top, 0); // as if nobody had guessed: narrower ones may pass by luck
}

std::optional<Setting> LeastSetting::next(const Setting& at, int by) {
  std::vector<Setting> moves;
  for (std::size_t knob = 0; knob < knobs_; ++knob)
    if (const auto lower = lowered_(at, knob, by)) moves.push_back(*lower);
  ask_all(moves);
  std::optional<Setting> best;
  for (const Setting& move : moves)
    if (trial(move).passes && (!best || better_move(trial(move), trial(*best), trial(at)))) best = move;
  return best;
}

// A stride that succeeded is doubled, one that failed is halved; the end has failed at one less and at two.
Setting LeastSetting::descended(Setting at, int stride) {
  for (;;) {
    if (const auto lower = next(at, stride)) {
      at = *lower;
      stride *= 2;
    } else if (stride > 1) {
      stride /= 2;
    } else if (const auto lucky = next(at, 2)) {
      at = *lucky;
    } else {
      return at;
    }
  }
}

std::optional<Setting> LeastSetting::cheaper_than(const Setting& at,
                                                  const std::vector<Setting>& tried) const {
  std::optional<Setting> best;
  for (const auto& [setting, t] : seen_)
    if (t.passes && t.cost < trial(best.value_or(at)).cost &&
        std::find(tried.begin(), tried.end(), setting) == tried.end())
      best = setting;
  return best;
}

std::optional<Setting> LeastSetting::from(const Setting& start, std::optional<int> guess) {
  const std::optional<Setting> first = start_of(start, guess);
  if (!first) return std::nullopt;
  int stride = 1;
  while (4 * stride < *std::max_element(first->begin(), first->begin() + static_cast<std::ptrdiff_t>(knobs_)))
    stride *= 2;
  Setting least = descended(*first, stride);
  std::vector<Setting> tried;
  while (const auto cheaper = cheaper_than(least, tried)) {
    tried.push_back(*cheaper);
    const Setting other = descended(*cheaper, 1);
    if (trial(other).cost < trial(least).cost) least = other;
  }
  return least;
}

} // namespace hopmesh::study
