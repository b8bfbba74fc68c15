// The reference as a level: the same steps in double, none of the firmware's arithmetic.
#pragma once

#include "sim/levels/image_force.h"
#include "sim/levels/mover.h"
#include "sim/levels/reference_check.h"
#include "sim/reference/answerers.h"
#include "sim/reference/block_network.h"

namespace hopmesh::levels {

class ReferenceMover : public Mover {
 public:
  /// Fires in the order of the array, and as its output stage does: its sweeps are comparable.
  ReferenceMover(const scene::Scene& scene, const BuiltMesh& mesh, const spec::ArraySpec& array);

  StepRow advance() override;
  const std::vector<double>& positions() const override { return position_; }
  StepState state() const override;
  void restore(const StepState& state, const std::vector<SignalRange>& seen) override;
  /// From now on its networks are answered so, instead of by the scene's threshold and max_sweeps: by the
  /// sweeps that an array took, or by the rest.
  void answer_after(reference::SweepsOfSteps sweeps);
  void answer_at_rest();
  const reference::Formulation& formulation() const { return *motion_.formulation; }
  /// The network of the last step; valid after advance().
  const reference::Step& last_step() const { return last_; }

 private:
  /// Share of the last step's fall that it left.
  double left_of_fall();

  const BuiltMesh& mesh_;
  reference::StepParameters motion_;
  std::optional<ImageForce> image_;
  const reference::Order order_;
  reference::State state_;
  reference::Step last_;
  std::optional<reference::BlockNetwork> blocks_; ///< the last step's network
  std::vector<double> position_;
};

} // namespace hopmesh::levels
