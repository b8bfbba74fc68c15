#include "sim/study/study_run.h"

#include "sim/files/output_file.h"
#include "sim/input/command_words.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/level.h"
#include "sim/run/children.h"
#include "sim/run/progress.h"
#include "sim/study/study_folder.h"
#include "sim/study/truth_store.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>

namespace hopmesh::study {

namespace {

namespace fs = std::filesystem;
using input::shell_word;

// A level keeps references to what it was made from: all of it lives as long as the motion.
std::shared_ptr<levels::Mover> mover_of(const std::string& method, const scene::Inputs& inputs) {
  struct Kept {
    levels::Prepared prepared;
    levels::ReadyLevel level;
  };
  auto kept = std::make_shared<Kept>();
  kept->prepared = {inputs, std::make_unique<levels::BuiltMesh>(inputs.scene)};
  kept->level = levels::make_ready(levels::level_named(method, "methods"), kept->prepared, true);
  levels::Mover* mover = kept->level.mover.get();
  return {kept, mover};
}

/// Levels, rivals, and the truth, which lies in the study's folder.
Methods all_methods(const fs::path& folder) {
  const auto truth = [store = TruthStore(folder)](const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                                                  const std::vector<double>& times) {
    return store.at(inputs, mesh, times);
  };
  return {levels::level_names(), mover_of, truth};
}

PointRow row_without_run(run::Outcome outcome, const std::string& sentence) {
  PointRow row;
  row.outcome = outcome;
  row.stability = Stability::blow_up;
  row.sentence = sentence;
  return row;
}

// In a child. What goes wrong is a row as well.
int one_point(const Study& study, const StudyFolder& folder, const Methods& methods, std::size_t number) {
  const Point point = point_of(study, number);
  PointRow row;
  try {
    row = run_point(point, inputs_of(study, point), study.times, methods, levels::stop_requested);
  } catch (const std::exception& error) {
    row = row_without_run(run::Outcome::failed, error.what());
  }
  if (levels::stop_requested || row.outcome == run::Outcome::interrupted) return run::child_stopped;
  folder.save(point, row);
  return run::child_done;
}

bool run_in_children(const Study& study, const StudyOrder& order, const StudyFolder& folder,
                     const Methods& methods) {
  std::vector<std::size_t> numbers = folder.missing();
  const auto of_others = [&](std::size_t n) { return n % order.share.of != order.share.first; };
  numbers.erase(std::remove_if(numbers.begin(), numbers.end(), of_others), numbers.end());
  run::CountProgress progress("points", numbers.size());
  std::size_t count = 0;
  const auto ended = [&](std::size_t n, const run::ChildEnd& end) {
    const bool asked = levels::stop_requested || end.exit_code == run::child_stopped;
    if (!asked && !folder.has(n))
      folder.save(point_of(study, n), row_without_run(run::Outcome::crashed, run::describe(end)));
    progress.count(++count);
  };
  return run::run_in_children(
      numbers, order.workers, [&](std::size_t n) { return one_point(study, folder, methods, n); }, ended,
      levels::stop_requested);
}

// Each task of the job array is this program on its share of the points; sbatch waits for all of them.
bool run_by_slurm(const Study& study, const StudyOrder& order, const StudyFolder& folder) {
  const std::size_t tasks = std::min(folder.missing().size(), order.workers);
  if (tasks == 0) return true;
  const std::string program = fs::read_symlink("/proc/self/exe").string();
  const std::string where = fs::absolute(folder.path()).string();
  const std::string task =
      fmt::format("exec {} {} {} --out {} -j 1 --share \"$SLURM_ARRAY_TASK_ID/{}\"", shell_word(program),
                  order.verb, shell_word(fs::absolute(study.path).string()), shell_word(where), tasks);
  files::write_file(folder.path() / "task.sh", "#!/bin/sh\n" + task + "\n");
  const std::string command = fmt::format(
      "sbatch --quiet --wait --array=0-{} --ntasks=1 --cpus-per-task=1 --job-name=hopmesh "
      "--chdir={} --output={} {} < /dev/null >&2",
      tasks - 1, shell_word(where), shell_word(where + "/task-%a.log"), shell_word(where + "/task.sh"));
  std::fflush(nullptr);
  const int status = std::system(command.c_str());
  if (status != 0)
    fmt::print(stderr, "hopmesh: sbatch, or a task of its, ended with {}; see task-*.log in {}\n", status,
               where);
  return folder.missing().empty();
}

std::string rest_text(const Study& study, const StudyOrder& order, std::size_t missing) {
  return fmt::format("{}: {} of {} points are done and safe.\nTo go on\n  hopmesh {} {} --out {}\n",
                     study.name, study.combinations() - missing, study.combinations(), order.verb,
                     shell_word(order.study), shell_word(order.folder.string()));
}

} // namespace

StudyEnd run_study(const Study& study, const StudyOrder& order) {
  const Methods methods = all_methods(order.folder);
  const std::uint64_t hash = check_points(study, methods);
  const StudyFolder folder(study, order.folder, hash, order.share.of == 1);
  levels::catch_interrupts();
  const auto began = std::chrono::steady_clock::now();
  const bool whole =
      order.slurm ? run_by_slurm(study, order, folder) : run_in_children(study, order, folder, methods);
  const std::size_t missing = folder.missing().size();
  if (!whole || order.share.of > 1 || missing > 0)
    return {whole                    ? run::Outcome::finished
            : levels::stop_requested ? run::Outcome::interrupted
                                     : run::Outcome::failed,
            rest_text(study, order, missing)};
  std::string counts;
  for (const auto& [status, count] : folder.collect())
    counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, status);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return {run::Outcome::finished,
          fmt::format("{}: {} points in {:.1f} s: {}\nResults\n  {}\n", study.name, study.combinations(),
                      seconds, counts, (order.folder / "results.csv").string())};
}

} // namespace hopmesh::study
