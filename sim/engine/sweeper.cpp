#include "sim/engine/sweeper.h"

namespace hopmesh::engine {

namespace {

struct Range {
  std::size_t first, last;
};

/// The part of [first, last) that one member of a team takes.
Range part(std::size_t first, std::size_t last, std::size_t member, std::size_t members) {
  const std::size_t count = last - first;
  return {first + count * member / members, first + count * (member + 1) / members};
}

/// How many chunks each stage = sweep * groups + group stays behind the first one: the least that leaves
/// every neighbour as plain sweeps would. Where two groups meet across chunks the later one comes to a chunk
/// after the earlier one has left the chunk in front of it; else after it has left that same chunk. A team
/// works on the stages of a wave at the same time, and keeps them one chunk further apart, so that they do
/// not touch.
std::vector<std::size_t> lags(const Layout& layout, std::size_t sweeps, bool team) {
  std::vector<std::size_t> lag(sweeps * layout.groups, 0);
  for (std::size_t k = 0; k < lag.size(); ++k)
    for (std::size_t j = k - std::min(k, layout.groups); j < k; ++j) {
      const bool meet = layout.groups_meet_across_chunks(j % layout.groups, k % layout.groups);
      lag[k] = std::max(lag[k], lag[j] + (meet ? 1 : 0) + (team ? 1 : 0));
    }
  return lag;
}

Detected detected(const SweepRecord& record, bool by_sum) {
  return {record.largest_change(), by_sum ? record.largest_sum() : 0, record.all_along()};
}

void merge(Detected& all, const Detected& more) {
  all.largest_change = std::max(all.largest_change, more.largest_change);
  all.largest_sum = std::max(all.largest_sum, more.largest_sum);
  all.along += more.along;
}

} // namespace

Sweeper::Sweeper(SweepCore& core, const Layout& layout, RunRule& rule, std::size_t threads,
                 std::size_t followed)
    : core_(core), layout_(layout), rule_(rule), followed_(layout.chunks > 1 ? followed : 1), team_(threads) {
  if (followed_ > 1) lag_ = lags(layout, followed_, team_.size() > 1);
}

void Sweeper::prepare() {
  team_.run([&](std::size_t member) {
    const Range blocks = part(0, layout_.blocks(), member, team_.size());
    core_.prepare(blocks.first, blocks.last);
  });
  core_.begin_run(rule_.by_sum());
}

// A member that is alone fires a whole sweep in one call.
void Sweeper::fire_sweep(std::size_t member, const SweepOrder& order, SweepRecord& record) {
  if (team_.size() == 1 && layout_.chunks == 1) return core_.fire(0, layout_.blocks(), order, record);
  for (std::size_t g = 0; g < layout_.groups; ++g) {
    fire_group(g, member, order, record);
    team_.barrier();
  }
}

// In a layout of one chunk, members share the blocks of the group; else each member keeps to its own chunks.
void Sweeper::fire_group(std::size_t group, std::size_t member, const SweepOrder& order,
                         SweepRecord& record) {
  const bool whole = layout_.chunks > 1;
  const Range chunks = whole ? part(0, layout_.chunks, member, team_.size()) : Range{0, layout_.chunks};
  for (std::size_t r = chunks.first; r < chunks.last; ++r) {
    const std::size_t at = r * layout_.groups + group;
    const Range all{layout_.first_block[at], layout_.first_block[at + 1]};
    const Range mine = whole ? all : part(all.first, all.last, member, team_.size());
    core_.fire(mine.first, mine.last, order, record);
  }
}

std::uint32_t Sweeper::relax(std::uint32_t limit, const std::atomic<bool>& stop, SweepResult& result) {
  return followed_ > 1 ? relax_following(limit, stop, result) : relax_plainly(limit, stop, result);
}

// The last of the sweeps alone may end in a restart.
void Sweeper::end_sweeps(std::uint32_t count, const Detected& last) {
  core_.end_sweeps(count);
  if (rule_.restarts(last)) core_.restart();
}

std::uint32_t Sweeper::relax_plainly(std::uint32_t limit, const std::atomic<bool>& stop,
                                     SweepResult& result) {
  std::vector<SweepRecord> own(team_.size());
  std::uint32_t done = 0;
  bool over = false;
  SweepOrder order{0, rule_.momentum()};
  team_.run([&](std::size_t member) {
    while (!over) {
      own[member].begin_sweep();
      fire_sweep(member, order, own[member]);
      if (member == 0) {
        result.detected = {};
        for (const SweepRecord& o : own) merge(result.detected, detected(o, rule_.by_sum()));
        end_sweeps(1, result.detected);
        result.over = rule_.over(result.detected);
        rule_.pass(result.detected);
        order.momentum = rule_.momentum();
        done += 1;
        over = result.over || done == limit || stop.load(std::memory_order_relaxed);
      }
      team_.barrier();
    }
  });
  for (const SweepRecord& o : own) result.extremes.merge(o.all_extremes());
  return done;
}

// In wave w, stage k works on chunk w - lag[k]. The members share the stages of a wave; each takes its own
// one after the other. `lags` compares a stage with the last few before it: those before them are further
// ahead still.
void Sweeper::follow(std::size_t sweeps, std::size_t member, std::vector<SweepRecord>& records) {
  const std::size_t stages = sweeps * layout_.groups, waves = layout_.chunks + lag_[stages - 1];
  std::size_t first = 0, last = 0;
  for (std::size_t wave = 0; wave < waves; ++wave) {
    while (last < stages && lag_[last] <= wave) ++last;
    while (wave >= lag_[first] + layout_.chunks) ++first;
    const Range mine = part(first, last, member, team_.size());
    for (std::size_t k = mine.first; k < mine.last; ++k) {
      const std::size_t at = (wave - lag_[k]) * layout_.groups + k % layout_.groups;
      const std::size_t sweep = k / layout_.groups;
      core_.fire(layout_.first_block[at], layout_.first_block[at + 1],
                 {static_cast<std::uint32_t>(sweep), rule_.momentum(sweep)}, records[sweep]);
    }
    team_.barrier();
  }
}

std::vector<SweepResult> Sweeper::follow(std::size_t sweeps) {
  std::vector<std::vector<SweepRecord>> own(team_.size(), std::vector<SweepRecord>(sweeps));
  team_.run([&](std::size_t member) { follow(sweeps, member, own[member]); });
  std::vector<SweepResult> each(sweeps);
  for (const auto& records : own)
    for (std::size_t k = 0; k < sweeps; ++k) {
      merge(each[k].detected, detected(records[k], rule_.by_sum()));
      each[k].extremes.merge(records[k].all_extremes());
    }
  return each;
}

/// How many of these sweeps the array would have done before something comes between two of them: the end of
/// the run, or a restart. Says of each whether the run is over with it.
std::size_t Sweeper::judged(std::vector<SweepResult>& each) const {
  RunRule rule = rule_;
  for (std::size_t k = 0; k < each.size(); ++k) {
    each[k].over = rule.over(each[k].detected);
    if (each[k].over || rule.restarts(each[k].detected)) return k + 1;
    rule.pass(each[k].detected);
  }
  return each.size();
}

// Which sweep ends the run, or ends in a restart, is known only when others that follow it have begun. Then
// the outputs go back to where these sweeps started, and exactly as many sweeps as needed are done again. The
// runs of a motion are much alike, so the length of the last run says after how many sweeps to look up.
std::uint32_t Sweeper::relax_following(std::uint32_t limit, const std::atomic<bool>& stop,
                                       SweepResult& result) {
  std::uint32_t done = 0;
  while (true) {
    const std::uint32_t left = std::min(limit, expected_ > done ? expected_ : limit) - done;
    const std::size_t count = std::min<std::size_t>(followed_, left);
    core_.keep_outputs();
    std::vector<SweepResult> each = follow(count);
    const std::size_t needed = judged(each);
    if (needed < count) {
      core_.restore_outputs();
      each = follow(needed);
      judged(each);
    }
    for (const SweepResult& sweep : each) {
      result.extremes.merge(sweep.extremes);
      rule_.pass(sweep.detected);
    }
    result.detected = each.back().detected;
    result.over = each.back().over;
    end_sweeps(static_cast<std::uint32_t>(needed), result.detected);
    done += static_cast<std::uint32_t>(needed);
    if (result.over || done == limit || stop.load(std::memory_order_relaxed)) return expected_ = done;
  }
}

} // namespace hopmesh::engine
