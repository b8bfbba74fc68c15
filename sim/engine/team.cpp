#include "sim/engine/team.h"

#include <exception>

namespace hopmesh::engine {

// A system that makes no more threads still has the work done, by those there are: a team changes no result.
Team::Team(std::size_t members) {
  threads_.reserve(members > 0 ? members - 1 : 0);
  try {
    for (std::size_t m = 1; m < members; ++m) threads_.emplace_back([this, m] { serve(m); });
  } catch (const std::exception&) {
  }
}

Team::~Team() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  called_.notify_all();
  for (std::thread& t : threads_) t.join();
}

void Team::run(const std::function<void(std::size_t)>& work) {
  if (threads_.empty()) return work(0);
  {
    const std::lock_guard lock(mutex_);
    work_ = &work;
    ++calls_;
  }
  called_.notify_all();
  work(0);
  barrier();
}

void Team::serve(std::size_t member) {
  std::uint64_t served = 0;
  while (true) {
    const std::function<void(std::size_t)>* work = nullptr;
    {
      std::unique_lock lock(mutex_);
      called_.wait(lock, [&] { return over_ || calls_ != served; });
      if (over_) return;
      served = calls_;
      work = work_;
    }
    (*work)(member);
    barrier();
  }
}

void Team::barrier() {
  if (threads_.empty()) return;
  constexpr int spins = 20000;
  const std::uint64_t round = round_.load(std::memory_order_acquire);
  if (waiting_.fetch_add(1, std::memory_order_acq_rel) + 1 == size()) {
    waiting_.store(0, std::memory_order_relaxed);
    round_.store(round + 1, std::memory_order_release);
    return;
  }
  for (int k = 0; round_.load(std::memory_order_acquire) == round; ++k)
    if (k >= spins) std::this_thread::yield();
}

} // namespace hopmesh::engine
