// The array without an event kernel: every bit by loops over blocks of cells, every cycle by formula.
// docs/hardware/engine.md walks through it.
#pragma once

#include "rtl_model/spec/cycles.h"
#include "sim/engine/sweeper.h"

#include <string>

namespace hopmesh::engine {

struct Options {
  std::size_t threads = 1;     ///< never changes a bit; useful_threads() knows how many help
  std::string kernel = "auto"; ///< or a name of kernel_names()
  std::size_t followed = 0; ///< sweeps that follow each other through the mesh; 0: as many as help; 1: none
};

/// An array, its memories and its way of relaxing. Neurons are numbered as in spec::Topology.
class Engine {
 public:
  /// The array must have passed spec::validate for the topology. Throws std::invalid_argument for a kernel
  /// that does not exist, or that this processor or this array cannot have.
  Engine(const spec::ArraySpec& array, const spec::Topology& topology, const Options& options = {});
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  const spec::ArraySpec& array() const { return array_; }
  const spec::Topology& topology() const { return topology_; }
  const spec::CycleModel& cycles() const { return cycles_; }
  std::size_t phases() const { return cycles_.phase.size(); }

  // Memories as words on the bus: cut to their formats as they are written, outputs held within [-1, 1].
  void write_weights(std::size_t first, const std::uint32_t* words, std::size_t count);
  void write_biases(std::size_t first, const std::uint32_t* words, std::size_t count);
  void write_outputs(std::size_t first, const std::uint32_t* words, std::size_t count);
  void read_weights(std::size_t first, std::uint32_t* words, std::size_t count) const;
  void read_biases(std::size_t first, std::uint32_t* words, std::size_t count) const;
  void read_outputs(std::size_t first, std::uint32_t* words, std::size_t count) const;
  // The table of m, of an array that has one.
  void write_momentum(std::size_t first, const std::uint32_t* words, std::size_t count);
  void read_momentum(std::size_t first, std::uint32_t* words, std::size_t count) const;

  /// Prepares a run; `advance` then goes on until it is over, until it has had `most` sweeps, or until `stop`
  /// says so between two sweeps: true when over. A run that was stopped goes on where it was.
  void begin_run(std::uint32_t threshold, std::uint32_t max_sweeps, const spec::StopRule& rule = {});
  bool advance(const std::atomic<bool>& stop, std::uint32_t most = UINT32_MAX);
  /// begin_run and advance in one call, without a stop.
  spec::Relaxation run(std::uint32_t threshold, std::uint32_t max_sweeps, const spec::StopRule& rule = {});
  const spec::Relaxation& result() const { return result_; }

  /// The widest swings of s and u over all runs.
  const spec::Extremes& extremes() const { return extremes_; }
  const char* kernel() const { return core_->name(); }
  /// Why none of the fast kernels can have this array, for people; empty if they can.
  std::string why_no_kernel() const;
  std::size_t threads() const { return sweeper_.threads(); }
  std::size_t bytes_per_sweep() const { return core_->bytes_per_sweep(); }

 private:
  std::pair<std::size_t, std::size_t> place(std::size_t neuron) const;

  const spec::ArraySpec array_;
  const spec::Topology topology_;
  const spec::Phases phases_of_sweep_;
  const spec::CycleModel cycles_;
  const NeuronPlan plan_;
  const Layout layout_;
  RunRule rule_;
  std::unique_ptr<SweepCore> core_;
  Sweeper sweeper_;
  std::uint32_t max_sweeps_ = 1;
  spec::Relaxation result_;
  spec::Extremes extremes_;
};

} // namespace hopmesh::engine
