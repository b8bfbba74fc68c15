// Work in the tasks of a Slurm job array.
#pragma once

#include <filesystem>
#include <string>

namespace hopmesh::study {

/// Runs a shell's line in so many tasks by sbatch, and waits for all of them; script and logs lie in the
/// folder, and $SLURM_ARRAY_TASK_ID is a task's number. What went wrong is told on stderr. Throws
/// input::InputError where there is no sbatch.
void run_by_slurm(const std::string& line, std::size_t tasks, const std::filesystem::path& folder);

} // namespace hopmesh::study
