// An array whose clock is in the caller's hand: how its runs go through their segments, whichever way its
// neurons are built.
#pragma once

#include "rtl_model/spec/cycles.h"
#include "rtl_model/spec/relaxation.h"
#include "rtl_model/spec/signals.h"
#include "sim/engine/neuron_plan.h"
#include "sim/engine/run_rule.h"

#include <memory>

namespace hopmesh::engine {

/// A register, or a place of a memory, as waves show it: its scopes below that of the array, and where its
/// code stands, in 64 bits or in 32.
struct Probe {
  static constexpr int in_prepare = -1, in_all = -2;

  std::vector<std::string> scopes;
  spec::Signal signal;
  const std::int64_t* wide;
  const std::int32_t* narrow;
  int changes; ///< in which phase; or one of the two above

  std::int64_t code() const { return wide ? *wide : *narrow; }
};

class ClockStepped {
 public:
  ClockStepped(const spec::ArraySpec& array, const spec::Topology& topology);
  virtual ~ClockStepped() = default;
  ClockStepped(const ClockStepped&) = delete;
  ClockStepped& operator=(const ClockStepped&) = delete;

  // Memories as words on the bus, as Engine takes them; outside a run.
  virtual void write_weights(std::size_t first, const std::uint32_t* words, std::size_t count) = 0;
  virtual void write_biases(std::size_t first, const std::uint32_t* words, std::size_t count) = 0;
  virtual void write_outputs(std::size_t first, const std::uint32_t* words, std::size_t count) = 0;
  void write_momentum(std::size_t first, const std::uint32_t* words, std::size_t count);

  /// START: cycle 0 is the one that now begins.
  void start(std::uint32_t threshold, std::uint32_t max_sweeps, const spec::StopRule& rule = {});
  /// Goes one clock on; does nothing when idle.
  virtual void step() { step(1); }
  /// Goes `clocks` clocks on, or to the end of the run where that comes before. Registers hold what they hold
  /// after the last of these clocks; values that nobody can see in between may be left out.
  void step(std::uint64_t clocks);

  /// Segment (a number of spec::Segment) and beat of the cycle that comes next.
  int segment() const { return segment_; }
  std::uint64_t beat() const { return beat_; }
  bool busy() const { return segment_ != spec::Segment::idle; }
  bool done() const { return done_; }
  /// The run up to now: complete sweeps, the largest change of the last one, cycles of the clock.
  const spec::Relaxation& result() const { return result_; }
  const spec::CycleModel& cycles() const { return cycles_; }
  const spec::Formats& formats() const { return plan_.formats; } ///< with the accumulator as built
  const spec::Phases& phases() const { return phases_; }
  const spec::Topology& topology() const { return topology_; }

  virtual std::int32_t state(std::size_t neuron) const = 0; ///< V after the last clock, raw
  bool has_momentum() const { return plan_.output == spec::Output::momentum; }
  /// Of a momentum array: the number of m in its table.
  std::int64_t entry() const { return entry_; }
  /// All that waves show of the array's own registers, and of these cells. Valid as long as the array.
  virtual std::vector<Probe> probes(const std::vector<std::size_t>& cells) const = 0;

 protected:
  /// Does the beats [first, last) of the segment at hand.
  virtual void do_beats(std::uint64_t first, std::uint64_t last) = 0;
  virtual void entered() {} ///< a segment has begun
  /// Momentum: Y takes the value of V, and neighbours see it.
  virtual void restart() {}
  /// m of the sweep at hand.
  std::int32_t momentum() const { return rule_.momentum(); }
  bool by_sum() const { return rule_.by_sum(); }

  const spec::Topology topology_;
  const spec::Phases phases_;
  const spec::CycleModel cycles_;
  const NeuronPlan plan_;
  int segment_ = spec::Segment::idle;
  std::uint64_t beat_ = 0, length_ = 0; ///< clocks of the segment that are over, and all of them
  Detected detected_;                   ///< of this sweep so far, as the convergence detector has it
  spec::Relaxation result_;

 private:
  void enter(int segment);
  void leave_segment();

  bool done_ = false;
  RunRule rule_;
  std::int64_t entry_ = 0;
  std::uint32_t max_sweeps_ = 1;
};

/// The clock-stepped array that the description asks for; it must have passed spec::validate.
std::unique_ptr<ClockStepped> make_clock_stepped(const spec::ArraySpec& array,
                                                 const spec::Topology& topology);

} // namespace hopmesh::engine
