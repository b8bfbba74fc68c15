// What is decided between two sweeps: whether the run is over, whether momentum begins anew, and which m the
// next sweep takes.
#pragma once

#include "rtl_model/spec/relaxation.h"

#include <algorithm>
#include <vector>

namespace hopmesh::engine {

/// What a sweep came to, as the convergence detector sees it.
struct Detected {
  std::int64_t largest_change = 0; ///< |Delta V|
  std::int64_t largest_sum = 0;    ///< |s| of neurons that may still move; 0 where it is not asked for
  std::int64_t along = 0;          ///< the sum of sign(s) Delta V; 0 without momentum
};

class RunRule {
 public:
  /// `entries`: of the table of m; 0: the array has none.
  explicit RunRule(std::size_t entries = 0) : table_(entries, 0) {}

  void begin(std::uint32_t threshold, const spec::StopRule& rule) {
    threshold_ = threshold;
    rule_ = rule;
    entry_ = 0;
    begun_ = false;
  }
  bool by_sum() const { return rule_.by_sum; }

  /// m of the sweep that comes after `ahead` others without a restart.
  std::int32_t momentum(std::size_t ahead = 0) const {
    return table_.empty() ? 0 : table_[std::min(entry_ + ahead, table_.size() - 1)];
  }
  std::size_t entry() const { return entry_; } ///< the number of m in its table
  bool restarts(const Detected& sweep) const { return sweep.along < 0; }
  /// Is the run over with this sweep? The run's first sweep is the one that was judged before any was passed.
  bool over(const Detected& sweep) const {
    if (!rule_.by_sum) return sweep.largest_change <= threshold_;
    const auto largest = static_cast<std::uint64_t>(sweep.largest_sum), first = begun_ ? first_sum_ : largest;
    return largest <= std::max(rule_.floor, rule_.share > 0 ? first >> rule_.share : 0);
  }
  /// Goes on behind a sweep.
  void pass(const Detected& sweep) {
    if (!begun_) first_sum_ = static_cast<std::uint64_t>(sweep.largest_sum);
    begun_ = true;
    if (restarts(sweep)) entry_ = 0;
    if (entry_ + 1 < table_.size()) entry_ += 1;
  }

  std::vector<std::int32_t>& table() { return table_; }
  const std::vector<std::int32_t>& table() const { return table_; }

 private:
  std::vector<std::int32_t> table_; ///< codes of m
  std::uint32_t threshold_ = 0;
  spec::StopRule rule_;
  std::size_t entry_ = 0;
  bool begun_ = false; ///< a sweep is behind
  std::uint64_t first_sum_ = 0;
};

} // namespace hopmesh::engine
