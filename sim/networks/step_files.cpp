#include "sim/networks/step_files.h"

#include "sim/files/matrix_market.h"
#include "sim/files/npy.h"
#include "sim/networks/certainty.h"

#include <fmt/format.h>

namespace hopmesh::networks {

void check_step_files(const std::filesystem::path& folder, const levels::BuiltMesh& mesh) {
  files::check_writable(folder, mesh.topology().weight_words() * 48 + mesh.nodes() * 256);
}

void write_step_files(const std::filesystem::path& folder, const levels::ReferenceMover& motion) {
  const auto& step = motion.last_step();
  const auto& W = step.network.W;
  std::vector<files::MatrixEntry> entries;
  for (Eigen::Index row = 0; row < W.outerSize(); ++row)
    for (std::decay_t<decltype(W)>::InnerIterator at(W, row); at; ++at)
      entries.push_back({static_cast<std::size_t>(at.row()), static_cast<std::size_t>(at.col()), at.value()});
  const auto n = static_cast<std::size_t>(W.rows());
  const auto values = [](const auto& v) { return std::vector<double>(v.data(), v.data() + v.size()); };
  files::write_matrix(folder / "W.mtx", n, n, entries);
  files::write_vector(folder / "bias.mtx", values(step.network.I));
  files::write_vector(folder / "V0.mtx", values(step.V0));
  files::write_vector(folder / "V.mtx", values(step.relaxation.V));
  files::NpyWriter<double> predicted(folder / "predicted.npy", std::vector<std::size_t>{3});
  const auto C = values(step.predicted);
  for (std::size_t node = 0; node < C.size() / 3; ++node) predicted.append(&C[3 * node]);
  predicted.commit();
}

std::string certain_text(const levels::ReferenceMover& motion, const levels::Prepared& p) {
  if (!motion.formulation().increment) return "";
  const reference::Step& step = motion.last_step();
  const spec::ArraySpec& array = p.inputs.array;
  const std::vector<std::uint32_t> component(static_cast<std::size_t>(step.V0.size()), 0);
  const solvers::Problem problem{step.network.W, step.network.I, step.V0, {}, component};
  const levels::ErrorBounds bounds(step.network, levels::order_for(*p.mesh, array.schedule), true);
  levels::RunRules rules = levels::rules_of(levels::motion_for(p.inputs.scene, array));
  rules.loads = true;
  const Certainty certainty = certainty_of(problem, step.relaxation.V, bounds, array, rules);
  return fmt::format("V is {}.\nOn the array {}, stopped by the scene's rule: {}.\n", told_text(certainty),
                     array.name, bound_text(certainty.bound));
}

} // namespace hopmesh::networks
