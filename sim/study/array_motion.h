// The way of the data at fixed levels: firmware integrator, driver, bus, array, and back.
#pragma once

#include "firmware/integrator.h"
#include "sim/study/bus_profile.h"
#include "sim/study/motion.h"
#include "sim/study/reference_check.h"

namespace hopmesh::study {

class ArrayMotion : public Motion {
 public:
  /// `check`: ask the reference beside every step.
  ArrayMotion(const scene::Scene& scene, const BuiltMesh& mesh, const spec::ArraySpec& array, ArrayPort& port,
              bool check);

  StepRow advance() override;
  const std::vector<double>& positions() const override { return position_; }
  std::vector<std::int32_t> outputs_raw() const override { return mesh_.by_node(raw(output_)); }
  std::vector<SignalRange> ranges() const override;

  /// What the last step loaded: start as raw codes [cells * components].
  std::vector<std::int32_t> start_raw() const { return raw(start_); }
  std::vector<std::int32_t> rest_raw() const { return raw(output_); }
  const hm_driver& driver() const { return driver_; }

 private:
  void open();
  std::uint64_t bus_cycles() const;
  std::vector<std::int32_t> raw(const std::vector<double>& outputs) const;
  std::uint64_t hash() const;
  void keep_finite(const std::vector<double>& before_x, const std::vector<double>& before_v,
                   const std::vector<double>& before_a);

  const BuiltMesh& mesh_;
  ArrayPort& port_;
  BusProfile profile_;
  std::optional<ReferenceCheck> check_;
  hm_motion motion_{};
  hm_driver driver_{};
  hm_state state_{};
  std::vector<double> position_, velocity_, acceleration_, predicted_, energy_change_, start_, weight_, bias_,
      output_;
  std::vector<std::uint32_t> buffer_;
};

/// The firmware's motion parameters of a scene; force is gravity plus wind.
hm_motion motion_of(const scene::Scene& scene);

/// A firmware error as a sentence.
std::string error_text(int error);

} // namespace hopmesh::study
