#include "sim/study/safe_folder.h"

#include "sim/files/output_file.h"
#include "sim/input/input_error.h"
#include "sim/input/whole_file.h"

#include <fmt/format.h>

namespace hopmesh::study {

SafeFolder::SafeFolder(std::filesystem::path folder, const char* rows, const FolderMark& mark, bool alone)
    : folder_(std::move(folder)), rows_(folder_ / rows) {
  files::check_writable(folder_, 0);
  if (alone) lock_.emplace(folder_);
  const std::filesystem::path place = folder_ / mark.name;
  const std::string text = fmt::format("{:016x}\n", mark.hash);
  if (!std::filesystem::exists(place)) {
    files::check_writable(rows_, 0);
    files::write_file(place, text);
  } else if (input::read_whole_file(place.string(), "the mark of a results folder", 1000) != text) {
    throw input::input_error(folder_.string(), 0, "--out", mark.found, mark.expected);
  }
}

files::CsvTable SafeFolder::row(const std::string& name, const std::vector<std::string>& columns) const {
  files::CsvTable table = files::read_csv(file(name));
  if (table.header != columns || table.rows.size() != 1)
    throw input::input_error(file(name).string(), 1, "", "no result of this work", "its header and one row");
  return table;
}

} // namespace hopmesh::study
