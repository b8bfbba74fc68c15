#include "sim/study/slurm.h"

#include "sim/files/output_file.h"
#include "sim/input/command_words.h"

#include <cstdlib>
#include <fmt/format.h>

namespace hopmesh::study {

using input::shell_word;

void run_by_slurm(const std::string& line, std::size_t tasks, const std::filesystem::path& folder) {
  const std::string where = std::filesystem::absolute(folder).string();
  files::write_file(folder / "task.sh", "#!/bin/sh\n" + line + "\n");
  const std::string command = fmt::format(
      "sbatch --quiet --wait --array=0-{} --ntasks=1 --cpus-per-task=1 --job-name=hopmesh "
      "--chdir={} --output={} {} < /dev/null >&2",
      tasks - 1, shell_word(where), shell_word(where + "/task-%a.log"), shell_word(where + "/task.sh"));
  std::fflush(nullptr);
  const int status = std::system(command.c_str());
  if (status != 0)
    fmt::print(stderr, "hopmesh: sbatch, or a task of its, ended with {}; see task-*.log in {}\n", status,
               where);
}

} // namespace hopmesh::study
