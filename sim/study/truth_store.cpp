#include "sim/study/truth_store.h"

#include "sim/files/npy.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/step_state.h"
#include "sim/run/checkpoint.h"
#include "sim/study/claimed_table.h"

#include <fmt/format.h>

namespace hopmesh::study {

namespace {

namespace fs = std::filesystem;

/// A row a time: how far the truth is known, and a hash of its positions, which stand in a file beside it.
const std::vector<std::string> columns{"time", "floor", "positions"};

std::string hash_text(const std::vector<double>& positions) {
  return fmt::format("{:016x}", levels::hash_on(0, positions.data(), positions.size()));
}

// The table comes last: where it is, the positions are.
void save(files::CsvWriter& table, const fs::path& stem, const std::vector<double>& times, const Truth& truth,
          std::size_t nodes) {
  files::NpyWriter<double> positions(stem.string() + ".npy", {nodes, 3});
  for (const auto& at : truth.positions) positions.append(at);
  positions.commit();
  for (std::size_t k = 0; k < times.size(); ++k)
    table.cell(times[k]).cell(truth.floor.at(k)).cell(hash_text(truth.positions.at(k))).end_row();
  table.commit();
}

/// The positions of a saved truth and their table prove each other.
class Saved {
 public:
  Saved(const fs::path& stem, const std::vector<double>& times, std::size_t nodes)
      : file_(stem.string() + ".csv"), times_(times), nodes_(nodes) {}

  Truth truth() const {
    const files::CsvTable table = files::read_kept(file_, columns);
    if (table.rows.size() != times_.size())
      throw damaged(0, "", fmt::format("{} rows", table.rows.size()), std::to_string(times_.size()));
    Truth truth;
    files::NpyReader<double> positions = reader();
    for (std::size_t k = 0; k < times_.size(); ++k) add(table, positions, k, truth);
    return truth;
  }

 private:
  files::DamagedFile damaged(std::size_t row, const char* key, const std::string& found,
                             const std::string& expected) const {
    return damaged_cell(file_, row, key, found, expected);
  }

  files::NpyReader<double> reader() const {
    const std::string place = fs::path(file_).replace_extension(".npy").string();
    try {
      files::NpyReader<double> found(place);
      if (found.shape() == std::vector<std::size_t>{times_.size(), nodes_, 3}) return found;
    } catch (const files::ReadError& why) {
      throw files::set_aside(file_, why.what());
    }
    throw damaged(0, "positions", "another shape in " + place, "that of this mesh");
  }

  void add(const files::CsvTable& table, files::NpyReader<double>& positions, std::size_t row,
           Truth& truth) const {
    const auto floor = table.number(row, "floor");
    if (!floor) throw damaged(row, "floor", input::in_quotes(table.text(row, "floor")), "a number");
    truth.floor.push_back(*floor);
    truth.positions.push_back(positions.row(row));
    const std::string found = hash_text(truth.positions.back()), wanted = table.text(row, "positions");
    if (found != wanted) throw damaged(row, "positions", "damaged values, hash " + found, wanted);
  }

  const fs::path file_;
  const std::vector<double>& times_;
  const std::size_t nodes_;
};

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
  std::optional<files::CsvWriter> table = claim_table(stem.string() + ".csv", columns);
  if (!table) return levels::stop_requested ? Truth() : Saved(stem, times, mesh.nodes()).truth();
  Truth truth = levels::exact_motion(inputs.scene, mesh, times);
  if (!truth.positions.empty()) save(*table, stem, times, truth, mesh.nodes());
  return truth;
}

} // namespace hopmesh::study
