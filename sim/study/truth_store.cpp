#include "sim/study/truth_store.h"

#include "sim/files/csv.h"
#include "sim/files/csv_table.h"
#include "sim/files/npy.h"
#include "sim/levels/step_state.h"
#include "sim/rivals/integrator.h"
#include "sim/rivals/truth.h"
#include "sim/run/checkpoint.h"

#include <fmt/format.h>
#include <unistd.h>

namespace hopmesh::study {

namespace {

namespace fs = std::filesystem;

constexpr double tolerance = 1e-11; // relative and absolute; far below what any rival reaches

// What the exact motion depends on: not the method, not the time step but through friction.
std::uint64_t hash_of(const rivals::Surroundings& around, const levels::BuiltMesh& mesh,
                      const std::vector<double>& times) {
  std::vector<double> numbers = around.numbers();
  numbers.insert(numbers.end(), times.begin(), times.end());
  return levels::hash_on(run::mesh_hash(mesh.mesh()), numbers.data(), numbers.size());
}

Truth solve(const rivals::Surroundings& around, const levels::BuiltMesh& mesh,
            const std::vector<double>& times) {
  const rivals::Truth found = rivals::solve(rivals::Physics(mesh.mesh(), around), times, tolerance);
  Truth truth;
  truth.floor = found.floor;
  for (const rivals::Vector& at : found.positions)
    truth.positions.emplace_back(at.data(), at.data() + at.size());
  return truth;
}

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
  rivals::surroundings_of(scene);
}

Truth TruthStore::at(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                     const std::vector<double>& times) const {
  const rivals::Surroundings around = rivals::surroundings_of(inputs.scene);
  const fs::path stem = folder_ / fmt::format("truth-{:016x}", hash_of(around, mesh, times));
  if (fs::exists(stem.string() + ".npy")) return saved(stem);
  try {
    Truth truth = solve(around, mesh, times);
    save(stem, truth, mesh.nodes());
    return truth;
  } catch (const rivals::LostMotion&) {
    return {};
  }
}

} // namespace hopmesh::study
