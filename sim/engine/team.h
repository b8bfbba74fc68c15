// A few threads that do the same work on different parts, again and again, in step with each other.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace hopmesh::engine {

/// The caller is member 0. Members spin at the barrier, since the work between two is a few microseconds, and
/// give way after a while, since the machine may have fewer cores than it says.
class Team {
 public:
  /// As many members as asked for, or as the system has threads for.
  explicit Team(std::size_t members);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  std::size_t size() const { return threads_.size() + 1; }
  /// Every member does work(member); returns when all have.
  void run(const std::function<void(std::size_t)>& work);
  /// Called inside `work`: no member goes on before all members are here.
  void barrier();

 private:
  void serve(std::size_t member);

  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable called_;
  const std::function<void(std::size_t)>* work_ = nullptr;
  std::uint64_t calls_ = 0;
  bool over_ = false;
  alignas(64) std::atomic<std::size_t> waiting_{0};
  alignas(64) std::atomic<std::uint64_t> round_{0};
};

} // namespace hopmesh::engine
