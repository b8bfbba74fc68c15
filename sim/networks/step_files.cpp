#include "sim/networks/step_files.h"

#include "sim/files/matrix_market.h"
#include "sim/files/npy.h"

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

} // namespace hopmesh::networks
