#include "sim/study/safe_folder.h"

#include "sim/files/kept_file.h"
#include "sim/files/output_file.h"
#include "sim/input/input_error.h"
#include "sim/input/whole_file.h"

#include <fmt/format.h>

namespace hopmesh::study {

SafeFolder::SafeFolder(std::filesystem::path folder, const char* rows, const FolderMark& mark,
                       std::vector<std::string> columns, bool alone)
    : folder_(std::move(folder)), rows_(folder_ / rows), columns_(std::move(columns)) {
  files::check_writable(folder_, 0);
  if (alone) lock_.emplace(folder_);
  const std::filesystem::path place = folder_ / mark.name;
  const std::string text = fmt::format("{:016x}\n", mark.hash);
  std::error_code ignored;
  if (!std::filesystem::exists(place, ignored)) {
    files::check_writable(rows_, 0);
    files::write_once(place, text);
  }
  if (input::read_whole_file(place.string(), "the mark of a results folder", 1000) != text)
    throw input::input_error(folder_.string(), 0, "--out", mark.found, mark.expected);
  files::check_writable(rows_, 0);
  expect_sound_rows();
}

// Damaged rows are set aside all at once, so that one more start makes them all again.
void SafeFolder::expect_sound_rows() const {
  std::vector<std::string> faults;
  for (const auto& entry : std::filesystem::directory_iterator(rows_)) {
    if (entry.path().extension() != ".csv") continue;
    try {
      row(entry.path().stem().string());
    } catch (const files::DamagedFile& fault) {
      faults.emplace_back(fault.what());
    }
  }
  if (faults.empty()) return;
  throw files::DamagedFile(
      faults[0] +
      (faults.size() == 1 ? "" : fmt::format(" ({} more files of this folder likewise)", faults.size() - 1)));
}

files::CsvTable SafeFolder::row(const std::string& name) const {
  files::CsvTable table = files::read_kept(file(name), columns_);
  if (table.rows.size() != 1) throw damaged(name, fmt::format("{} rows", table.rows.size()), "one row");
  return table;
}

files::DamagedFile SafeFolder::damaged(const std::string& name, const std::string& found,
                                       const std::string& expected, const std::string& key) const {
  const std::filesystem::path place = file(name);
  return files::set_aside(place, input::input_error(place.string(), 2, key, found, expected).what());
}

} // namespace hopmesh::study
