// A folder in which the results of long work gather, each in a file that is whole or absent: work that was
// killed goes on with what is there.
#pragma once

#include "sim/files/csv_table.h"
#include "sim/files/folder_lock.h"

#include <optional>

namespace hopmesh::study {

/// The file `name`, which says what inputs a folder belongs to; `found` and `expected` tell those who come
/// with others.
struct FolderMark {
  std::string name;
  std::uint64_t hash;
  std::string found, expected;
};

class SafeFolder {
 public:
  /// Makes the folder, with a folder `rows` for the results, or takes up what is there. Throws InputError
  /// where its mark has another hash. `alone`: lock the folder against other writers.
  SafeFolder(std::filesystem::path folder, const char* rows, const FolderMark& mark, bool alone);

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path file(const std::string& name) const { return rows_ / (name + ".csv"); }
  bool has(const std::string& name) const { return std::filesystem::exists(file(name)); }
  /// A result: one row under these columns. Throws InputError where the file holds anything else.
  files::CsvTable row(const std::string& name, const std::vector<std::string>& columns) const;

 private:
  const std::filesystem::path folder_, rows_;
  std::optional<files::FolderLock> lock_;
};

} // namespace hopmesh::study
