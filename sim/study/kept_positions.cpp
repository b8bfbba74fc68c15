#include "sim/study/kept_positions.h"

#include "sim/files/npy.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/step_state.h"
#include "sim/study/claimed_table.h"

#include <fmt/format.h>

namespace hopmesh::study {

using levels::ExactMotion;

namespace {

namespace fs = std::filesystem;

/// A row a time: how far the positions are known, and a hash of them; they stand in a file beside it.
const std::vector<std::string> position_columns{"time", "floor", "positions"};

std::string hash_text(const std::vector<double>& positions) {
  return fmt::format("{:016x}", levels::hash_on(0, positions.data(), positions.size()));
}

// The table comes last: where it is, the positions are.
void save(files::CsvWriter& table, const fs::path& stem, const std::vector<double>& times,
          const ExactMotion& motion, std::size_t nodes) {
  files::NpyWriter<double> positions(stem.string() + ".npy", {nodes, 3});
  for (const auto& at : motion.positions) positions.append(at);
  positions.commit();
  for (std::size_t k = 0; k < times.size(); ++k)
    table.cell(times[k]).cell(motion.floor.at(k)).cell(hash_text(motion.positions.at(k))).end_row();
  table.commit();
}

/// The saved positions and their table.
class Saved {
 public:
  Saved(const fs::path& stem, const std::vector<double>& times, std::size_t nodes)
      : file_(stem.string() + ".csv"), times_(times), nodes_(nodes) {}

  ExactMotion motion() const {
    const files::CsvTable table = files::read_kept(file_, position_columns);
    if (table.rows.size() != times_.size())
      throw damaged(0, "", fmt::format("{} rows", table.rows.size()), std::to_string(times_.size()));
    ExactMotion motion;
    files::NpyReader<double> positions = reader();
    for (std::size_t k = 0; k < times_.size(); ++k) add(table, positions, k, motion);
    return motion;
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
           ExactMotion& motion) const {
    const auto floor = table.number(row, "floor");
    if (!floor) throw damaged(row, "floor", input::in_quotes(table.text(row, "floor")), "a number");
    motion.floor.push_back(*floor);
    motion.positions.push_back(positions.row(row));
    const std::string found = hash_text(motion.positions.back()), wanted = table.text(row, "positions");
    if (found != wanted) throw damaged(row, "positions", "damaged values, hash " + found, wanted);
  }

  const fs::path file_;
  const std::vector<double>& times_;
  const std::size_t nodes_;
};

} // namespace

ExactMotion kept_positions(const fs::path& stem, const std::vector<double>& times, std::size_t nodes,
                           const std::function<ExactMotion()>& work_out) {
  std::optional<files::CsvWriter> table = claim_table(stem.string() + ".csv", position_columns);
  if (!table) return levels::stop_requested ? ExactMotion() : Saved(stem, times, nodes).motion();
  ExactMotion motion = work_out();
  if (!motion.positions.empty()) save(*table, stem, times, motion, nodes);
  return motion;
}

} // namespace hopmesh::study
