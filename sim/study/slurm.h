// Work in the tasks of a Slurm job array.
#pragma once

#include <filesystem>
#include <string>

namespace hopmesh::study {

/// The number of a task within it, as a shell has it.
inline constexpr const char* slurm_task = "$SLURM_ARRAY_TASK_ID";

/// Runs a shell's line in so many tasks by sbatch, and waits for all of them; script and logs lie in the
/// folder. What went wrong is told on stderr.
void run_by_slurm(const std::string& line, std::size_t tasks, const std::filesystem::path& folder);

} // namespace hopmesh::study
