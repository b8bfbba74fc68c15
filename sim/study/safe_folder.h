// A folder in which the results of long work gather, each in a file that is whole or absent and proves its
// content: work that was killed goes on with what is there.
#pragma once

#include "sim/files/csv.h"
#include "sim/files/folder_lock.h"
#include "sim/files/kept_file.h"

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
  /// where its mark has another hash, DamagedFile where results are not as they were written. `columns`: of a
  /// result. `alone`: lock the folder against other writers.
  SafeFolder(std::filesystem::path folder, const char* rows, const FolderMark& mark,
             std::vector<std::string> columns, bool alone);

  const std::filesystem::path& path() const { return folder_; }
  bool has(const std::string& name) const { return std::filesystem::exists(file(name)); }
  /// A result: one row under the columns. Throws DamagedFile where the file holds anything else.
  files::CsvTable row(const std::string& name) const;
  /// Takes one row; safe from any kill once it is committed.
  files::CsvWriter writer(const std::string& name) const {
    return {file(name), columns_, files::CheckedRows()};
  }
  /// A result that cannot be one of this work, whatever its check says. Sets it aside.
  files::DamagedFile damaged(const std::string& name, const std::string& found, const std::string& expected,
                             const std::string& key = "") const;

 private:
  std::filesystem::path file(const std::string& name) const { return rows_ / (name + ".csv"); }
  void expect_sound_rows() const;

  const std::filesystem::path folder_, rows_;
  const std::vector<std::string> columns_;
  std::optional<files::FolderLock> lock_;
};

} // namespace hopmesh::study
