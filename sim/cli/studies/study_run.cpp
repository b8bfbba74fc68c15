#include "sim/cli/studies/study_run.h"

#include "sim/cli/options.h"
#include "sim/cli/usage.h"
#include "sim/files/output_file.h"
#include "sim/input/number.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/level.h"
#include "sim/run/children.h"
#include "sim/run/progress.h"
#include "sim/study/reference_store.h"
#include "sim/study/study_folder.h"
#include "sim/study/truth_store.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fmt/format.h>
#include <thread>
#include <unistd.h>

namespace hopmesh::cli {

namespace {

namespace fs = std::filesystem;

/// Every N-th point from K on; a whole study is 0/1.
struct Share {
  std::size_t first = 0, of = 1;
};

Share share_of(const StudyOptions& o) {
  Share share;
  if (o.share.empty()) return share;
  const std::string_view text = o.share;
  const std::size_t slash = std::min(text.find('/'), text.size() - 1);
  if (!input::parse_number(text.substr(0, slash), share.first) ||
      !input::parse_number(text.substr(slash + 1), share.of) || share.first >= share.of)
    throw input::input_error("", 0, "--share", o.share, "K/N with K from 0 to N - 1");
  return share;
}

std::size_t workers_of(const StudyOptions& o) {
  return o.workers > 0 ? static_cast<std::size_t>(o.workers)
                       : std::max(1u, std::thread::hardware_concurrency());
}

fs::path folder_of(const StudyOptions& o, const study::Study& study) {
  if (!o.out.empty()) return o.out;
  std::string name = study.name;
  std::replace(name.begin(), name.end(), '/', '-');
  return fs::path("out") / name;
}

// In a child. What goes wrong is a row as well.
int one_point(const study::Study& study, const study::StudyFolder& folder, const study::Methods& methods,
              std::size_t number) {
  const study::Point point = study::point_of(study, number);
  study::PointRow row;
  try {
    row =
        study::run_point(point, study::inputs_of(study, point), study.times, methods, levels::stop_requested);
  } catch (const std::exception& error) {
    row.outcome = run::Outcome::failed;
    row.stability = study::Stability::blow_up;
    row.sentence = error.what();
  }
  if (levels::stop_requested || row.outcome == run::Outcome::interrupted) return interrupted;
  folder.save(point, row);
  return done;
}

void keep_crash(const study::Study& study, const study::StudyFolder& folder, std::size_t number,
                const run::ChildEnd& end) {
  study::PointRow row;
  row.outcome = run::Outcome::crashed;
  row.stability = study::Stability::blow_up;
  row.sentence = run::describe(end);
  folder.save(study::point_of(study, number), row);
}

bool run_local(const StudyOptions& o, const study::Study& study, const study::StudyFolder& folder,
               const study::Methods& methods) {
  const Share share = share_of(o);
  std::vector<std::size_t> numbers = folder.missing();
  numbers.erase(std::remove_if(numbers.begin(), numbers.end(),
                               [&](std::size_t n) { return n % share.of != share.first; }),
                numbers.end());
  run::CountProgress progress("points", numbers.size());
  std::size_t count = 0;
  return run::run_in_children(
      numbers, workers_of(o), [&](std::size_t n) { return one_point(study, folder, methods, n); },
      [&](std::size_t n, const run::ChildEnd& end) {
        const bool asked = levels::stop_requested || end.exit_code == interrupted;
        if (!asked && !folder.has(n)) keep_crash(study, folder, n, end);
        progress.count(++count);
      },
      levels::stop_requested);
}

// Each task of the job array is this program on its share of the points; sbatch waits for all of them.
bool run_slurm(const StudyOptions& o, const study::Study& study, const study::StudyFolder& folder) {
  const std::size_t tasks = std::min(folder.missing().size(), workers_of(o));
  if (tasks == 0) return true;
  const std::string program = fs::read_symlink("/proc/self/exe").string();
  const std::string where = fs::absolute(folder.path()).string();
  const std::string task =
      fmt::format("exec {} {} {} --out {} -j 1 --share \"$SLURM_ARRAY_TASK_ID/{}\"", shell_word(program),
                  o.verb, shell_word(fs::absolute(study.path).string()), shell_word(where), tasks);
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

void tell_rest(const StudyOptions& o, const study::Study& study, const study::StudyFolder& folder) {
  const std::size_t missing = folder.missing().size();
  fmt::print("{}: {} of {} points are done and safe.\nTo go on\n  hopmesh {} {} --out {}\n", study.name,
             study.combinations() - missing, study.combinations(), o.verb, shell_word(o.study),
             shell_word(folder.path().string()));
}

// A level keeps references to what it was made from: all of it lives as long as the motion.
std::shared_ptr<levels::Mover> motion_of(const std::string& method, const scene::Inputs& inputs) {
  struct Kept {
    levels::Prepared prepared;
    levels::ReadyLevel level;
  };
  auto kept = std::make_shared<Kept>();
  kept->prepared = {inputs, std::make_unique<levels::BuiltMesh>(inputs.scene)};
  kept->level = levels::make_ready(levels::level_named(method, "methods"), kept->prepared, true);
  levels::Mover* motion = kept->level.mover.get();
  return {kept, motion};
}

} // namespace

void add_study(CLI::App& verb, StudyOptions& o) {
  o.verb = verb.get_name();
  verb.add_option("STUDY", o.study, "a study file, or the name of a shipped study")->required();
  verb.add_option("--out", o.out,
                  "results folder (out/NAME of the study); one that is there is gone on with");
  verb.add_option("-j", o.workers, "so many points at a time (as many as processors); changes no result")
      ->check(whole_number(1, 1024));
  verb.add_option("--executor", o.executor, "local, or slurm: a job array of -j tasks by sbatch")
      ->check(one_name_of({"local", "slurm"}))
      ->capture_default_str();
  verb.add_option("--share", o.share, "K/N: only the points K, K + N, ...: several machines, one folder");
}

study::Methods all_methods(const fs::path& folder) {
  const auto truth = [store = study::TruthStore(folder)](
                         const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                         const std::vector<double>& times) { return store.at(inputs, mesh, times); };
  const auto reference =
      [store = study::ReferenceStore(folder)](const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                                              const std::vector<double>& times, std::uint64_t steps,
                                              const std::atomic<bool>& stop) {
        return store.at(inputs, mesh, times, steps, stop);
      };
  return {levels::level_names(), motion_of, truth, reference};
}

int run_study(const StudyOptions& o, const study::Study& study, fs::path& where) {
  where = folder_of(o, study);
  const study::Methods methods = all_methods(where);
  const Share share = share_of(o);
  const std::uint64_t hash = study::check_points(study, methods);
  const study::StudyFolder folder(study, where, hash, share.of == 1);
  levels::catch_interrupts();
  const auto began = std::chrono::steady_clock::now();
  const bool whole =
      o.executor == "slurm" ? run_slurm(o, study, folder) : run_local(o, study, folder, methods);
  if (!whole || share.of > 1 || !folder.missing().empty()) {
    tell_rest(o, study, folder);
    return whole ? done : levels::stop_requested ? interrupted : differs;
  }
  std::string counts;
  for (const auto& [status, count] : folder.collect())
    counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, status);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  fmt::print("{}: {} points in {:.1f} s: {}\nResults\n  {}\n", study.name, study.combinations(), seconds,
             counts, (where / "results.csv").string());
  return done;
}

} // namespace hopmesh::cli
