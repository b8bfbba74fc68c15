// A folded array clock by clock: elements, hold registers and stages as the rounds of the description lead
// them.
#pragma once

#include "sim/engine/aligned.h"
#include "sim/engine/clocked/clock_stepped.h"
#include "sim/engine/generic/drive_path.h"
#include "sim/engine/generic/wide_sum.h"

namespace hopmesh::engine {

/// Follows the neurons of rounds through a stage: which of them have done so many cycles of it.
class Follower {
 public:
  void begin(const spec::ArraySpec& array, std::uint64_t depth) {
    *this = {};
    shared_ = spec::shares_stage(array);
    depth_ = depth;
  }
  /// Elements [first, last) of a round whose neurons come so far in this cycle; asked of every cycle in turn.
  struct Part {
    const spec::Round* round = nullptr;
    std::size_t first = 0, last = 0;
  };
  Part in_cycle(std::uint64_t cycle, const spec::Rounds& rounds);

 private:
  bool shared_ = false;
  std::uint64_t depth_ = 0;
  std::size_t round_ = 0, element_ = 0;
};

class ClockedFold final : public ClockStepped {
 public:
  /// The array must be folded, and have passed spec::validate for the topology.
  ClockedFold(const spec::ArraySpec& array, const spec::Topology& topology);

  void write_weights(std::size_t first, const std::uint32_t* words, std::size_t count) override;
  void write_biases(std::size_t first, const std::uint32_t* words, std::size_t count) override;
  void write_outputs(std::size_t first, const std::uint32_t* words, std::size_t count) override;

  std::vector<Probe> probes(const std::vector<std::size_t>& cells) const override;

  // Memories of a neuron, and registers of an element or of a stage (0, where it is shared), raw codes.
  std::int32_t state(std::size_t neuron) const override { return state_[position_[neuron]]; }
  std::int32_t link(std::size_t neuron) const { return link_[bank_ + position_[neuron]]; }
  /// Y, of a momentum array.
  std::int32_t extrapolated(std::size_t neuron) const { return extrapolated_[position_[neuron]]; }
  std::int64_t reciprocal(std::size_t neuron) const { return reciprocal_[position_[neuron]]; }
  std::int64_t sum(std::size_t element) const { return element_.sum[element]; }
  std::int64_t norm(std::size_t element) const { return element_.norm[element]; }
  std::int64_t held(std::size_t element) const { return element_.held[element]; }
  std::int64_t drive(std::size_t stage) const { return stage_.drive[stage]; }
  std::int64_t change(std::size_t stage) const { return stage_.change[stage]; } ///< Delta V
  std::size_t elements() const { return element_.sum.size(); }
  std::size_t stages() const { return stage_.drive.size(); }

 private:
  void place_neurons();
  void find_sources();
  void do_beats(std::uint64_t first, std::uint64_t last) override;
  void entered() override;
  void restart() override;
  void do_prepare(std::uint64_t cycle);
  void do_phase(std::uint64_t cycle, const spec::Rounds& rounds);
  /// The round that accumulates in this cycle, or none.
  const spec::Round* adding(std::uint64_t cycle, const spec::Rounds& rounds);
  void add_taps(std::size_t position, std::size_t first_tap, std::int64_t& sum) const;
  void add_magnitudes(std::size_t position, std::size_t first_tap, std::int64_t& norm) const;
  void leave(const spec::Round& round);
  void normalise(std::size_t position, std::size_t stage);
  void move(std::size_t position, std::size_t count, std::int64_t* changes) const;
  void detect(std::size_t position, std::size_t count, const std::int64_t* changes);
  void publish(const Follower::Part& part);
  /// Of the neuron of an element: its number in the order of the sweep.
  std::size_t position(const spec::Round& round, std::size_t element) const {
    return first_position_[round.phase] + round.first + element;
  }
  std::size_t stage_of(std::size_t element) const { return shared_ ? 0 : element; }

  const spec::ArraySpec array_;
  const spec::Fold fold_;
  const DrivePath path_;
  const WideSum wide_sum_;
  const ShiftRounding to_state_, to_link_, gained_;
  const StepRounding step_;
  const std::size_t lanes_;
  const bool shared_;

  // By position: neurons in the order in which the sweep takes them.
  std::vector<std::size_t> first_position_;      ///< of each phase
  std::vector<std::uint32_t> neuron_, position_; ///< of each position; and the position of each neuron
  std::vector<std::size_t> first_tap_;           ///< of each position in weight_ and source_, and behind all
  std::vector<std::int32_t> weight_;
  std::vector<std::uint32_t> source_; ///< the position that a tap reads
  AlignedVector<std::int32_t> bias_, state_, extrapolated_; ///< extrapolated_: of momentum
  AlignedVector<std::int32_t> link_; ///< two banks in synchronous arrays
  std::size_t bank_ = 0, write_bank_ = 0;
  AlignedVector<std::int64_t> norm_, reciprocal_, multiplier_;
  std::vector<int> places_;
  AlignedVector<std::int64_t> sum_, drive_; ///< s and u that go with a neuron through its stage

  struct {
    AlignedVector<std::int64_t> neuron, sum, norm, held;
  } element_;
  struct {
    AlignedVector<std::int64_t> neuron, drive, change;
  } stage_;
  std::size_t adding_ = 0; ///< a round that is not over
  Follower driven_, pulled_, published_;
};

} // namespace hopmesh::engine
