#include "sim/study/truth_store.h"

#include "sim/files/csv.h"
#include "sim/files/csv_table.h"
#include "sim/files/npy.h"
#include "sim/levels/step_state.h"
#include "sim/run/checkpoint.h"

#include <fmt/format.h>
#include <unistd.h>

namespace hopmesh::study {

namespace {

namespace fs = std::filesystem;

// Two points may work out the same one at the same time: each writes files of its own, the last name wins.
// Positions come last: where they are, the floor is.
void save(const fs::path& stem, const Truth& truth, std::size_t nodes) {
  const std::string own = stem.string() + fmt::format(".{}", getpid());
  files::CsvWriter floor(own + ".csv", {"floor"});
  for (double f : truth.floor) floor.cell(f).end_row();
  floor.commit();
  files::NpyWriter<double> positions(own + ".npy", {nodes, 3});
  for (const auto& at : truth.positions) positions.append(at);
  positions.commit();
  for (const char* ending : {".csv", ".npy"}) fs::rename(own + ending, stem.string() + ending);
}

Truth saved(const fs::path& stem) {
  Truth truth;
  const files::CsvTable floor = files::read_csv(stem.string() + ".csv");
  for (std::size_t k = 0; k < floor.rows.size(); ++k)
    truth.floor.push_back(floor.number(k, "floor").value_or(0));
  files::NpyReader<double> positions(stem.string() + ".npy");
  for (std::size_t k = 0; k < positions.rows(); ++k) truth.positions.push_back(positions.row(k));
  return truth;
}

} // namespace

void TruthStore::expect_known(const scene::Scene& scene) {
  levels::exact_surroundings(scene);
}

Truth TruthStore::at(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                     const std::vector<double>& times) const {
  std::vector<double> numbers = levels::exact_surroundings(inputs.scene);
  numbers.insert(numbers.end(), times.begin(), times.end());
  const std::uint64_t hash = levels::hash_on(run::mesh_hash(mesh.mesh()), numbers.data(), numbers.size());
  const fs::path stem = folder_ / fmt::format("truth-{:016x}", hash);
  if (fs::exists(stem.string() + ".npy")) return saved(stem);
  Truth truth = levels::exact_motion(inputs.scene, mesh, times);
  if (!truth.positions.empty()) save(stem, truth, mesh.nodes());
  return truth;
}

} // namespace hopmesh::study
