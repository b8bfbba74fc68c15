// Points in child processes: one a point, so that a crash takes one point only and SystemC elaborates once.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

namespace hopmesh::study {

/// Exit codes of a child: its work is done, or the user stopped it.
inline constexpr int child_done = 0, child_stopped = 130;

/// How a child ended. Neither: it left with exit code 0.
struct ChildEnd {
  int exit_code = 0, signal = 0;
};

/// Calls `work` for each number, in children of this process, at most `workers` at a time; `ended` is called
/// here. A child that is left alone by a killed parent dies too. False: `stop` was set, and children were
/// ended before their time.
bool run_in_children(const std::vector<std::size_t>& numbers, std::size_t workers,
                     const std::function<int(std::size_t)>& work,
                     const std::function<void(std::size_t, const ChildEnd&)>& ended,
                     const std::atomic<bool>& stop);

} // namespace hopmesh::study
