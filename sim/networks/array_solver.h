// The array as one more solver of a step's network: level engine, swept one by one, judged in double by its
// raw outputs.
#pragma once

#include "sim/levels/level.h"
#include "sim/levels/networks/loaded_array.h"
#include "sim/networks/solvers/solver_runs.h"

namespace hopmesh::networks {

/// An array that holds one network. Vectors are numbered as solvers::reached() does.
class StepArray {
 public:
  /// `whole`: the network over all nodes; like `prepared`, it must outlive this.
  StepArray(const solvers::Problem& whole, const levels::Prepared& prepared);

  /// The first loads weights, biases and the start. Throws levels::Stopped where the user stops it, and
  /// solvers::Unfit where its outputs are binary.
  void sweep();
  solvers::Vector outputs() const;
  double last_place() const { return array_.last_place(); }
  std::uint64_t cycles_per_sweep() const { return cycles_; }
  /// The network as its memories have it; none where rows were scaled one by one.
  std::optional<solvers::Problem> loaded() const;

 private:
  void load_and_sweep();

  const solvers::Problem& whole_;
  const levels::Prepared& prepared_;
  const std::unique_ptr<levels::ArrayPort> port_;
  levels::LoadedArray array_;
  std::uint64_t cycles_ = 0;
};

/// The run of an array, on until it stands still; `problem` is what reached() leaves of the array's.
solvers::SolverRun run_array(StepArray& array, const solvers::Problem& problem, const solvers::Answer& answer,
                             solvers::Limits limits, const std::atomic<bool>& stop);

/// Where it came lowest, and what keeps it from the answer, in lines for people.
std::string stall_text(const StepArray& array, const solvers::SolverRun& solver_run,
                       const solvers::Problem& problem, const solvers::Answer& answer);

} // namespace hopmesh::networks
