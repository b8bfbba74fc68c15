// What a step in whole numbers stands on, made once of the mesh and the motion, and the state between doubles
// and whole numbers: a real host would keep the whole numbers from step to step, here they are made of the
// doubles that everybody else reads.
#pragma once

#include "firmware/fixed/fixed.h"
#include "sim/levels/hosts/step_host.h"

namespace hopmesh::levels {

class FixedMotion {
 public:
  /// `place.memory` is at its start: ranges follow from it.
  explicit FixedMotion(const HostPlace& place);

  /// Before the first step: in last places of that array's state.
  void set_threshold(const hm_driver& driver);
  void take();
  void give();

  const hm_fixed_plan& plan() const { return plan_; }
  hm_fixed_mesh mesh() const { return {springs_.data(), nodes_.data()}; }
  hm_fixed_state& state() { return state_; }

  std::vector<std::int32_t> position, way, predicted, change, output, start, direction, next, weight, kick;
  std::vector<std::int64_t> bias, energy;

 private:
  void choose_places();
  void choose_units();
  void add_springs();
  void add_nodes();
  void set_motion();
  double unit() const;

  const HostPlace place_;
  hm_fixed_plan plan_{};
  hm_fixed_state state_{};
  std::vector<hm_fixed_spring> springs_;
  std::vector<hm_fixed_node> nodes_;
};

/// Why whole numbers do not cover such a motion, as a key, what it is, and what it should be; all null where
/// they do.
struct Refusal {
  const char *key = nullptr, *found = nullptr, *expected = nullptr;
};
Refusal why_not_fixed(const scene::Scene& scene, const spec::ArraySpec& array, const HostPlace& place);

} // namespace hopmesh::levels
