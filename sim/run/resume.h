// A run that was killed or stopped, ready to go on: its checkpoint and its files have been read and proven,
// and nothing has been touched.
#pragma once

#include "sim/files/folder_lock.h"
#include "sim/run/checkpoint.h"
#include "sim/run/step_log.h"

namespace hopmesh::run {

/// What is there of the files that grow with the steps; RunFiles takes them up.
struct RunStreams {
  files::FolderLock lock;
  files::StreamRest positions, table;
  std::optional<files::StreamRest> outputs; ///< of levels with codes
  std::uint64_t steps = 0;                  ///< in each of them
};

struct ResumedRun {
  Checkpoint saved;
  scene::Inputs inputs;
  std::unique_ptr<levels::BuiltMesh> mesh;
  StepLog rows; ///< of the steps done
  RunStreams streams;
};

/// Throws scene::InputError for a folder without a checkpoint and for whatever does not fit it, with the line
/// of the checkpoint that says so; record::WriteError if another run holds the folder.
ResumedRun read_run(const std::filesystem::path& folder);

} // namespace hopmesh::run
