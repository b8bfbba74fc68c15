#include "sim/study/size/step_bounds.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::study {

namespace {

constexpr std::uint64_t most_looks = 4;

/// Metres that an output of 1 moves its node by.
double reach_of(const reference::Step& step, const std::vector<double>& position,
                const levels::BuiltMesh& m) {
  const std::size_t n = m.components();
  double moved = 0, output = 0;
  for (std::size_t node = 0; node < m.nodes(); ++node)
    for (std::size_t p = 0; p < n; ++p) {
      const auto x = static_cast<Eigen::Index>(3 * node + m.firmware().axis[p]);
      const double V = step.relaxation.V[static_cast<Eigen::Index>(node * n + p)];
      if (std::abs(V) <= output) continue;
      output = std::abs(V);
      moved = std::abs(position[static_cast<std::size_t>(x)] - step.predicted[x]);
    }
  return output > 0 ? moved / output : 0;
}

} // namespace

StepBounds::StepBounds(const levels::ReferenceMover& motion, const levels::BuiltMesh& mesh,
                       const scene::Inputs& inputs)
    : motion_(motion), mesh_(mesh), order_(levels::order_for(mesh, inputs.array.schedule)),
      every_(std::max<std::uint64_t>(1, static_cast<std::uint64_t>(inputs.scene.motion.steps) / most_looks)) {
}

void StepBounds::step(const levels::StepRow& row, const levels::Mover& motion) {
  const bool fits =
      static_cast<Eigen::Index>(mesh_.topology().neurons()) <= levels::ErrorBounds::most_inverted;
  if (row.step % every_ != every_ / 2 || !fits || !motion_.formulation().increment) return;
  const reference::Step& step = motion_.last_step();
  const double outputs_a_node =
      static_cast<double>(mesh_.topology().neurons()) / static_cast<double>(mesh_.nodes());
  Kept kept{std::make_unique<levels::ErrorBounds>(step.network, order_, true),
            reach_of(step, motion.positions(), mesh_) * std::sqrt(outputs_a_node)};
  if (kept.bounds->definite() && kept.metres > 0) kept_.push_back(std::move(kept));
}

std::optional<StepBounds::Metres> StepBounds::of(const scene::Inputs& inputs) const {
  levels::RunRules rules = levels::rules_of(levels::motion_for(inputs.scene, inputs.array));
  rules.loads = true;
  Metres metres{0, true};
  for (const Kept& kept : kept_) {
    const auto bound = kept.bounds->of(inputs.array, rules);
    if (!bound) return std::nullopt;
    metres.most = std::max(metres.most, kept.metres * bound->least());
    metres.proved &= bound->proved;
  }
  return kept_.empty() ? std::nullopt : std::optional(metres);
}

} // namespace hopmesh::study
