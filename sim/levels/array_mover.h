// The way of the data at fixed levels: firmware integrator, driver, bus, array, and back.
#pragma once

#include "firmware/driver.h"
#include "sim/levels/bus_profile.h"
#include "sim/levels/codes.h"
#include "sim/levels/image_force.h"
#include "sim/levels/left_over.h"
#include "sim/levels/mover.h"
#include "sim/levels/reference_check.h"
#include "sim/levels/step_memory.h"

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
  StepState state() const override;
  void restore(const StepState& state, const std::vector<SignalRange>& seen) override;

  /// What the last step loaded and came to, [cells * components]; exact, as V is a whole number of last
  /// places.
  Codes start_raw() const { return to_codes(memory_.start, driver_.state); }
  Codes rest_raw() const { return to_codes(memory_.now.output, driver_.state); }
  /// Sweeps of each relaxation of the last step.
  const std::vector<std::uint32_t>& last_sweeps() const { return sweeps_; }
  const hm_driver& driver() const { return driver_; }

 private:
  void open();
  void look_back(StepRow& row);
  void keep();
  void put_kept_back();
  std::uint64_t bus_cycles() const;

  const BuiltMesh& mesh_;
  ArrayPort& port_;
  BusProfile profile_;
  std::optional<ReferenceCheck> check_;
  std::optional<LeftOver> left_over_;
  std::optional<ImageForce> image_;
  hm_step_parameters motion_{};
  const scene::RelaxSpec relax_;
  hm_driver driver_{};
  StepMemory memory_;
  std::vector<double> rest_; ///< V that the last good step left: the next one works in memory_.now.output
  std::vector<SignalRange> seen_; ///< before restore()
  std::vector<std::uint32_t> sweeps_;
  std::vector<double> loaded_; ///< weights that the array has, where a later step may go on with them
  std::vector<std::uint32_t> buffer_;
  double judging_seconds_ = 0;
};

/// The firmware's parameters of a scene's steps; force is gravity plus wind.
hm_step_parameters step_parameters(const scene::Scene& scene);

} // namespace hopmesh::levels
