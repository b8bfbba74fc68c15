// The files that the program reads, each with good examples and the code that reads it.
#pragma once

#include "tests/campaigns/mutants/mutation.h"

#include <filesystem>
#include <functional>

namespace hopmesh::campaigns {

struct Reader {
  std::string name;
  std::string file; ///< what a mutant is called, in a folder of its own
  Seeds seeds;
  std::filesystem::path beside; ///< a copy of this folder is around the mutant; empty: nothing is
  /// Reads the mutant in the folder as the program does. Throws input::InputError or files::WriteError for
  /// what is refused; everything else that it throws is a fault.
  std::function<void(const std::filesystem::path& folder)> read;
  void (*repair)(std::string& bytes) = nullptr; ///< of every second mutant; null: it has no checks
  bool leaves_traces = false;                   ///< reading changes the folder
};

/// What people write or bring: scenes, arrays, studies, meshes, pictures, matrices, vectors. `made`: where to
/// put what stands beside them.
std::vector<Reader> readers_of_foreign_files(const std::filesystem::path& made);
/// What studies and searches keep, and what charts are made of.
std::vector<Reader> readers_of_kept_files(const std::filesystem::path& made);
/// What a run that was killed goes on with; the program is run and killed for it.
std::vector<Reader> readers_of_stopped_runs(const std::filesystem::path& made);
/// All readers of the campaign.
std::vector<Reader> all_readers(const std::filesystem::path& made);
/// Files of a reader, read by whole processes of the program: a verb over each.
std::vector<Reader> all_programs(const std::filesystem::path& made);

/// The reader of that name. Throws std::out_of_range.
const Reader& reader_named(const std::vector<Reader>& readers, const std::string& name);

/// The contents of all files with such an ending, of the folder and those in it, in the order of their names.
Seeds contents_of(const std::filesystem::path& folder, const std::string& ending);

} // namespace hopmesh::campaigns
