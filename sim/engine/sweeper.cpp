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

} // namespace

Sweeper::Sweeper(Core& core, const Layout& layout, spec::Schedule schedule, std::size_t threads,
                 std::size_t followed)
    : core_(core), layout_(layout),
      followed_(layout.chunks > 1 && schedule != spec::Schedule::synchronous ? followed : 1), team_(threads) {
}

void Sweeper::prepare() {
  team_.run([&](std::size_t member) {
    const Range blocks = part(0, layout_.blocks(), member, team_.size());
    core_.prepare(blocks.first, blocks.last);
  });
  core_.begin_run();
}

// A whole sweep in one go where nobody shares it.
void Sweeper::fire_sweep(std::size_t member, Swept& swept) {
  if (team_.size() == 1 && layout_.chunks == 1) return core_.fire(0, layout_.blocks(), swept);
  for (std::size_t g = 0; g < layout_.groups; ++g) {
    fire_group(g, member, swept);
    team_.barrier();
  }
}

// One chunk: the group's blocks are shared out. Several: each member keeps to its own chunks.
void Sweeper::fire_group(std::size_t group, std::size_t member, Swept& swept) {
  const bool whole = layout_.chunks > 1;
  const Range chunks = whole ? part(0, layout_.chunks, member, team_.size()) : Range{0, layout_.chunks};
  for (std::size_t r = chunks.first; r < chunks.last; ++r) {
    const std::size_t at = r * layout_.groups + group;
    const Range all{layout_.first_block[at], layout_.first_block[at + 1]};
    const Range mine = whole ? all : part(all.first, all.last, member, team_.size());
    core_.fire(mine.first, mine.last, swept);
  }
}

std::uint32_t Sweeper::relax(std::uint32_t threshold, std::uint32_t limit, const std::atomic<bool>& stop,
                             Relaxed& relaxed) {
  return followed_ > 1 ? relax_following(threshold, limit, stop, relaxed)
                       : relax_plainly(threshold, limit, stop, relaxed);
}

std::uint32_t Sweeper::relax_plainly(std::uint32_t threshold, std::uint32_t limit,
                                     const std::atomic<bool>& stop, Relaxed& relaxed) {
  std::vector<Swept> own(team_.size());
  std::uint32_t done = 0;
  bool over = false;
  team_.run([&](std::size_t member) {
    while (!over) {
      own[member].begin_sweep();
      fire_sweep(member, own[member]);
      if (member == 0) {
        core_.end_sweep();
        relaxed.largest_change = 0;
        for (const Swept& o : own)
          relaxed.largest_change = std::max(relaxed.largest_change, o.largest_change());
        done += 1;
        over = relaxed.largest_change <= threshold || done == limit || stop.load(std::memory_order_relaxed);
      }
      team_.barrier();
    }
  });
  for (const Swept& o : own) relaxed.extremes.merge(o.all_extremes());
  return done;
}

// Stage k = sweep * groups + group comes to a chunk after stage k - 1 has left the chunk behind it, and
// before stage k + 1 reaches the chunk in front: then a link, which reaches no further, finds every neighbour
// as plain sweeps would leave it. Alone, a member takes the stages of a wave one after the other, each one
// chunk behind the last; a team keeps them two chunks apart, so that a wave's stages do not touch and can be
// shared out.
void Sweeper::follow(std::size_t sweeps, std::size_t member, std::vector<Swept>& swept) {
  const std::size_t stages = sweeps * layout_.groups, apart = team_.size() == 1 ? 1 : 2;
  const std::size_t waves = layout_.chunks + apart * (stages - 1);
  for (std::size_t wave = 0; wave < waves; ++wave) {
    const std::size_t first = wave < layout_.chunks ? 0 : (wave - layout_.chunks) / apart + 1;
    const std::size_t last = std::min(stages, wave / apart + 1);
    const Range mine = part(first, last, member, team_.size());
    for (std::size_t k = mine.first; k < mine.last; ++k) {
      const std::size_t at = (wave - apart * k) * layout_.groups + k % layout_.groups;
      core_.fire(layout_.first_block[at], layout_.first_block[at + 1], swept[k / layout_.groups]);
    }
    team_.barrier();
  }
}

std::vector<Relaxed> Sweeper::follow(std::size_t sweeps) {
  std::vector<std::vector<Swept>> own(team_.size(), std::vector<Swept>(sweeps));
  team_.run([&](std::size_t member) { follow(sweeps, member, own[member]); });
  std::vector<Relaxed> each(sweeps);
  for (const auto& swept : own)
    for (std::size_t k = 0; k < sweeps; ++k) {
      each[k].largest_change = std::max(each[k].largest_change, swept[k].largest_change());
      each[k].extremes.merge(swept[k].all_extremes());
    }
  return each;
}

// The sweep that ends the run is known only when all that follow it have begun: then back, and exactly so
// far.
std::uint32_t Sweeper::relax_following(std::uint32_t threshold, std::uint32_t limit,
                                       const std::atomic<bool>& stop, Relaxed& relaxed) {
  std::uint32_t done = 0;
  while (true) {
    const std::size_t count = std::min<std::size_t>(followed_, limit - done);
    core_.keep_outputs();
    std::vector<Relaxed> each = follow(count);
    std::size_t needed = 1;
    while (needed < count && each[needed - 1].largest_change > threshold) ++needed;
    if (needed < count) {
      core_.restore_outputs();
      each = follow(needed);
    }
    for (const Relaxed& sweep : each) relaxed.extremes.merge(sweep.extremes);
    relaxed.largest_change = each.back().largest_change;
    done += static_cast<std::uint32_t>(needed);
    if (relaxed.largest_change <= threshold || done == limit || stop.load(std::memory_order_relaxed))
      return done;
  }
}

} // namespace hopmesh::engine
