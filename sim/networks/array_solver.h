// The array as one more solver of a step's network: level engine, swept one by one, judged in double by its
// raw outputs.
#pragma once

#include "sim/levels/level.h"
#include "sim/levels/networks/loaded_array.h"
#include "sim/networks/solvers/solver_runs.h"

namespace hopmesh::networks {

/// An array that holds one network. Vectors are numbered as solvers::reached() does, but for whole ones.
class StepArray {
 public:
  /// `whole`: the network over all nodes; like `prepared`, it must outlive this. `array`: in place of the
  /// prepared one, which it may be.
  StepArray(const solvers::Problem& whole, const levels::Prepared& prepared, const spec::ArraySpec& array);

  /// The first loads weights, biases and the start. Throws levels::Stopped where the user stops it, and
  /// solvers::Unfit where its outputs are binary.
  void sweep();
  /// Loads the network and relaxes it from the start by the scene's rule.
  spec::Relaxation rest();
  /// Relaxes from outputs by that rule, beside other biases; both whole, as is what is returned.
  solvers::Vector rest_beside(const solvers::Vector& bias, const solvers::Vector& output);
  double room() { return array_.room(); } ///< for such biases

  solvers::Vector outputs() const;
  solvers::Vector whole_outputs() const;
  double last_place() const { return array_.last_place(); }
  std::uint64_t cycles_per_sweep() const { return a_sweep_; }
  /// What hardware would have taken for all of it: of sweep(), a single run with as many sweeps.
  const solvers::HardwareWork& work() const { return work_; }
  /// The network as its memories have it, over all nodes; none where rows were scaled one by one.
  std::optional<solvers::Problem> loaded() const;

 private:
  void expect_steps() const;
  void open();
  levels::CellNetwork network() const;
  void load_and_sweep();
  void count(const spec::Relaxation& run, std::uint64_t bus_cycles);
  void set_seconds();

  const solvers::Problem& whole_;
  const levels::Prepared& prepared_;
  const spec::ArraySpec spec_;
  const std::unique_ptr<levels::ArrayPort> port_;
  levels::LoadedArray array_;
  std::uint64_t a_sweep_ = 0; ///< cycles
  solvers::HardwareWork work_;
};

/// The run of an array, on until it stands still; `problem` is what reached() leaves of the array's.
solvers::SolverRun run_array(const std::string& name, StepArray& array, const solvers::Problem& problem,
                             const solvers::Answer& answer, solvers::Limits limits,
                             const std::atomic<bool>& stop);
/// The run of an array whose answers are corrected by their residuals; a relaxation after the other, each by
/// the scene's rule.
solvers::SolverRun run_corrected(const std::string& name, StepArray& array, const solvers::Problem& whole,
                                 const solvers::Problem& problem, const solvers::Answer& answer,
                                 const solvers::Limits& limits, const std::atomic<bool>& stop);

/// Where it came lowest, and what keeps it from the answer, in lines for people.
std::string stall_text(const StepArray& array, const solvers::SolverRun& solver_run,
                       const solvers::Problem& problem, const solvers::Answer& answer);

} // namespace hopmesh::networks
