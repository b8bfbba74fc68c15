// The way of the data at fixed levels: firmware integrator, driver, bus, array, and back.
#pragma once

#include "sim/levels/bus_profile.h"
#include "sim/levels/codes.h"
#include "sim/levels/hosts/step_host.h"
#include "sim/levels/hosts/word_by_word.h"
#include "sim/levels/image_force.h"
#include "sim/levels/left_over.h"
#include "sim/levels/mover.h"
#include "sim/levels/reference_check.h"

namespace hopmesh::levels {

class ArrayMover : public Mover {
 public:
  /// `check`: ask the reference beside every step.
  ArrayMover(const scene::Scene& scene, const BuiltMesh& mesh, const spec::ArraySpec& array, ArrayPort& port,
             bool check);

  StepRow advance() override;
  const std::vector<double>& positions() const override { return memory_.now.position; }
  std::vector<std::int32_t> outputs_raw() const override { return mesh_.by_node(rest_raw()); }
  std::vector<SignalRange> ranges() const override;
  double judging_seconds() const override { return judging_seconds_; }
  HostCounts host_counts() const override;
  StepState state() const override;
  void restore(const StepState& state, const std::vector<SignalRange>& seen) override;

  /// What the last step loaded and came to, [cells * components]; exact, as V is a whole number of last
  /// places.
  Codes start_raw() const { return to_codes(memory_.start, driver().state); }
  Codes rest_raw() const { return to_codes(memory_.now.output, driver().state); }
  /// Sweeps of each relaxation of the last step.
  const std::vector<std::uint32_t>& last_sweeps() const { return step_.sweeps; }
  const hm_driver& driver() const { return host_->driver(); }

 private:
  void open();
  void look_back(StepRow& row);
  void keep();
  void put_kept_back();
  std::uint64_t bus_cycles() const;

  const BuiltMesh& mesh_;
  ArrayPort& port_;
  BusProfile profile_;
  WordByWord words_; ///< before it, where no bus master moves bursts
  std::optional<ReferenceCheck> check_;
  std::optional<LeftOver> left_over_;
  std::optional<ImageForce> image_;
  hm_step_parameters motion_{};
  const scene::RelaxSpec relax_;
  StepMemory memory_;
  std::unique_ptr<StepHost> host_;
  bool opened_ = false;
  HostStep step_;            ///< the last one
  std::vector<double> rest_; ///< V that the last good step left: the next one works in memory_.now.output
  std::vector<SignalRange> seen_; ///< before restore()
  double judging_seconds_ = 0;
};

/// The firmware's parameters of a scene's steps; force is gravity plus wind.
hm_step_parameters step_parameters(const scene::Scene& scene);

} // namespace hopmesh::levels
