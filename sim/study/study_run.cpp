#include "sim/study/study_run.h"

#include "sim/files/kept_file.h"
#include "sim/files/output_file.h"
#include "sim/input/command_words.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/level.h"
#include "sim/run/children.h"
#include "sim/run/progress.h"
#include "sim/study/reference_store.h"
#include "sim/study/sensitivity_store.h"
#include "sim/study/slurm.h"
#include "sim/study/study_folder.h"
#include "sim/study/truth_store.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <new>
#include <system_error>

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

/// Levels, rivals, and the motions that all are measured against, which lie in the study's folder.
Methods all_methods(const fs::path& folder) {
  const auto truth = [store = TruthStore(folder)](const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                                                  const std::vector<double>& times) {
    return store.at(inputs, mesh, times);
  };
  const auto reference =
      [store = ReferenceStore(folder)](const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                                       const std::vector<double>& times, std::uint64_t steps,
                                       const std::atomic<bool>& stop) {
        return store.at(inputs, mesh, times, steps, stop);
      };
  const auto sensitivity = [store = SensitivityStore(folder)](
                               const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                               const std::vector<double>& times) { return store.at(inputs, mesh, times); };
  return {levels::level_names(), mover_of, truth, reference, sensitivity};
}

PointRow row_without_run(run::Outcome outcome, const std::string& sentence) {
  PointRow row;
  row.outcome = outcome;
  row.stability = Stability::blow_up;
  row.sentence = sentence;
  return row;
}

// In a child. What goes wrong with a point is a row as well; what the system or a damaged file refuses to any
// point is not.
PointRow row_of(const Study& study, const Methods& methods, const Point& point) {
  try {
    return run_point(point, inputs_of(study, point), study.times, methods, levels::stop_requested);
  } catch (const files::DamagedFile&) {
    throw;
  } catch (const files::WriteError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::system_error&) {
    throw;
  } catch (const std::exception& error) {
    return row_without_run(run::Outcome::failed, error.what());
  }
}

int one_point(const Study& study, const StudyFolder& folder, const Methods& methods, std::size_t number) {
  const Point point = point_of(study, number);
  const PointRow row = row_of(study, methods, point);
  if (levels::stop_requested || row.outcome == run::Outcome::interrupted) return run::child_stopped;
  folder.save(point, row);
  return run::child_done;
}

/// Points of the order's share that are not there yet.
std::vector<std::size_t> missing_of(const StudyOrder& order, const StudyFolder& folder) {
  std::vector<std::size_t> numbers = folder.missing();
  const auto of_others = [&](std::size_t n) { return n % order.share.of != order.share.first; };
  numbers.erase(std::remove_if(numbers.begin(), numbers.end(), of_others), numbers.end());
  return numbers;
}

// A worker that was ended from outside says nothing about its point, which stays missing.
bool run_in_children(const Study& study, const StudyOrder& order, const StudyFolder& folder,
                     const Methods& methods) {
  const std::vector<std::size_t> numbers = missing_of(order, folder);
  run::CountProgress progress("points", numbers.size());
  std::size_t count = 0;
  const auto ended = [&](std::size_t n, const run::ChildEnd& end) {
    const bool asked = levels::stop_requested || end.exit_code == run::child_stopped || end.from_outside();
    if (!asked && !folder.has(n))
      folder.save(point_of(study, n), row_without_run(run::Outcome::crashed, run::describe(end)));
    progress.count(++count);
  };
  return run::run_in_children(
      numbers, order.workers, [&](std::size_t n) { return one_point(study, folder, methods, n); }, ended,
      levels::stop_requested);
}

// Each task of the job array is this program on its share of the points.
bool run_in_tasks(const Study& study, const StudyOrder& order, const StudyFolder& folder) {
  const std::size_t tasks = std::min(folder.missing().size(), order.workers);
  if (tasks == 0) return true;
  const std::string program = fs::read_symlink("/proc/self/exe").string();
  run_by_slurm(fmt::format("exec {} {} {} --out {} -j 1 --share \"$SLURM_ARRAY_TASK_ID/{}\"",
                           shell_word(program), order.verb, shell_word(fs::absolute(study.path).string()),
                           shell_word(fs::absolute(folder.path()).string()), tasks),
               tasks, folder.path());
  return folder.missing().empty();
}

std::string rest_text(const Study& study, const StudyOrder& order, std::size_t missing,
                      run::Outcome outcome) {
  const bool lost = outcome == run::Outcome::failed && !order.slurm;
  return fmt::format("{}: {} of {} points are done and safe{}.\nTo go on\n  hopmesh {} {} --out {}\n",
                     study.name, study.combinations() - missing, study.combinations(),
                     lost ? "; workers of others were ended from outside" : "", order.verb,
                     shell_word(order.study), shell_word(order.folder.string()));
}

} // namespace

StudyEnd run_study(const Study& study, const StudyOrder& order) {
  const Methods methods = all_methods(order.folder);
  const std::uint64_t hash = check_points(study, methods);
  const StudyFolder folder(study, order.folder, hash, order.share.alone);
  levels::catch_interrupts();
  const auto began = std::chrono::steady_clock::now();
  const bool whole =
      order.slurm ? run_in_tasks(study, order, folder) : run_in_children(study, order, folder, methods);
  const std::size_t missing = folder.missing().size();
  if (!whole || !order.share.alone || missing > 0) {
    const run::Outcome outcome = levels::stop_requested              ? run::Outcome::interrupted
                                 : missing_of(order, folder).empty() ? run::Outcome::finished
                                                                     : run::Outcome::failed;
    return {outcome, rest_text(study, order, missing, outcome)};
  }
  std::string counts;
  for (const auto& [status, count] : folder.collect())
    counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, status);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return {run::Outcome::finished,
          fmt::format("{}: {} points in {:.1f} s of wall time: {}\nResults\n  {}\n", study.name,
                      study.combinations(), seconds, counts, (order.folder / "results.csv").string())};
}

} // namespace hopmesh::study
