// hopmesh vectors: jobs and answers for a core that is not ours, and the judge of what it answered.
#include "sim/cosim/vectors.h"

#include "sim/cli/options.h"
#include "sim/cosim/random_job.h"
#include "sim/input/count_text.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/level.h"
#include "sim/run/array_info.h"
#include "sim/run/progress.h"
#include "sim/run/simulation.h"

#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

using cosim::VectorCase;
using input::grouped;

struct VectorsOptions {
  CommonOptions common;
  std::int64_t step = -1, sweeps = 0, random = 0;
  std::uint64_t seed = 1;
  std::string out, check, level = levels::default_level().name;
  bool blank = false;
};

void refuse(const char* flag, const char* found, const std::string& expected) {
  throw input::input_error("", 0, flag, found, expected);
}

// A single source: a scene's step, random cases, or a file to judge; and no flag that belongs to another.
void check_options(const VectorsOptions& o) {
  const int sources = !o.common.scene.empty() + (o.random > 0) + !o.check.empty();
  if (sources != 1)
    refuse("vectors", sources == 0 ? "nothing to do" : "several sources",
           "one of SCENE --step K, --random N, or --check FILE");
  if (o.common.scene.empty() != (o.step < 0))
    refuse("--step", o.step < 0 ? "none" : "no scene", "SCENE --step K");
  if (o.common.scene.empty() && (!o.common.array.empty() || !o.common.overrides.empty() || o.sweeps > 0))
    refuse("vectors", "--array, --set or --sweeps without a scene", "SCENE");
  if (o.check.empty() == o.out.empty())
    refuse("--out", o.out.empty() ? "none" : "a file beside --check",
           "a file for the vectors, or --check FILE");
  if (o.blank && !o.check.empty()) refuse("--blank", "a file beside --check", "--out FILE");
  levels::level_named(o.level, "--level", {levels::Kind::array});
}

/// Arrays of the level for cases that come in the same order twice: SystemC's are all made before one is
/// used.
class Arrays {
 public:
  explicit Arrays(const std::string& level) : level_(levels::level_named(level, "--level")) {}
  bool ahead() const { return level_.made_ahead; }
  void expect(const cosim::ArrayJob& job) { made_.push_back(level_.make_port(job.array, job.topology, {})); }
  const hm_bus& next(const cosim::ArrayJob& job) {
    if (ahead()) return made_.at(used_++)->bus();
    made_.clear();
    expect(job);
    return made_.back()->bus();
  }

 private:
  const levels::Level& level_;
  std::vector<std::unique_ptr<levels::ArrayPort>> made_;
  std::size_t used_ = 0;
};

// ---- sources ----

// The network that the driver loads in a step (of several expansions the last).
std::optional<VectorCase> case_of_step(VectorsOptions& o) {
  if (o.step >= 0) o.common.overrides.push_back("motion.steps=" + std::to_string(o.step + 1));
  const levels::Prepared p = prepare(o.common);
  levels::PortRequest request;
  request.remarks = true;
  const levels::ReadyLevel level = levels::make_ready(levels::default_level(), p, false, request);
  run::RunResult result;
  {
    const auto steps = static_cast<std::uint64_t>(o.step) + 1;
    run::Progress progress(steps);
    result = run::simulate(*level.mover, steps, {&progress}, levels::stop_requested);
  }
  if (result.rows.size() <= static_cast<std::size_t>(o.step)) {
    fmt::print("{}\n", result.sentence);
    return std::nullopt;
  }
  VectorCase a_case{
      fmt::format("{} step {}", p.inputs.scene.name, o.step),
      cosim::loaded_job(level.port->bus(), p.inputs.array, p.mesh->topology(), level.array->start_raw())};
  if (o.sweeps > 0) a_case.job.max_sweeps = static_cast<std::uint32_t>(o.sweeps);
  return a_case;
}

VectorCase random_case(const VectorsOptions& o, std::int64_t k) {
  const std::uint64_t seed = o.seed + static_cast<std::uint64_t>(k);
  return {fmt::format("random {}", seed), cosim::random_job(seed)};
}

int write_vectors(VectorsOptions& o) {
  levels::catch_interrupts();
  std::optional<VectorCase> step;
  const bool of_scene = !o.common.scene.empty();
  if (of_scene && !(step = case_of_step(o))) return levels::stop_requested ? interrupted : differs;
  const std::int64_t cases = of_scene ? 1 : o.random;
  const auto number = [&](std::int64_t k) { return of_scene ? *step : random_case(o, k); };
  Arrays arrays(o.level);
  for (std::int64_t k = 0; k < cases && arrays.ahead() && !o.blank; ++k) arrays.expect(number(k).job);
  files::check_writable(std::filesystem::absolute(o.out).parent_path(), 1 << 20);
  cosim::VectorWriter file(o.out);
  for (std::int64_t k = 0; k < cases; ++k) {
    if (levels::stop_requested) return interrupted;
    const VectorCase a_case = number(k);
    file.add(a_case, o.blank ? nullptr : &arrays.next(a_case.job));
  }
  file.commit();
  fmt::print("{}: {} cases, {}\n", o.out, grouped(static_cast<std::uint64_t>(cases)),
             o.blank ? "without answers" : "answers by level " + o.level);
  return done;
}

// ---- the judge ----

int check_vectors(const VectorsOptions& o) {
  levels::catch_interrupts();
  Arrays arrays(o.level);
  VectorCase a_case;
  if (arrays.ahead())
    for (cosim::VectorReader reader(o.check); reader.next(a_case);) arrays.expect(a_case.job);
  cosim::VectorReader reader(o.check);
  std::uint64_t cases = 0, lines = 0;
  for (; reader.next(a_case); ++cases) {
    if (levels::stop_requested) return interrupted;
    const std::string wrong = cosim::check_answers(o.check, reader, a_case, arrays.next(a_case.job), lines);
    if (wrong.empty()) continue;
    fmt::print("{}\n", wrong);
    return differs;
  }
  if (cases == 0) throw input::input_error(o.check, 0, "", "no case", "case NAME");
  fmt::print("{}: {} cases, {} lines of answers, all right (level {})\n", o.check, grouped(cases),
             grouped(lines), o.level);
  return done;
}

int vectors(VectorsOptions& o) {
  check_options(o);
  try {
    return o.check.empty() ? write_vectors(o) : check_vectors(o);
  } catch (const levels::Stopped&) {
    return interrupted;
  }
}

} // namespace

void add_vectors(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<VectorsOptions>();
  CLI::App* verb = program.add_subcommand(
      "vectors", "test vectors for a core that is not ours, and the judge of what it answered");
  add_common(*verb, o->common);
  verb->get_option("SCENE")->required(false);
  verb->add_option("--step", o->step, "the network of this step of SCENE, counted from 0")
      ->check(whole_number(0));
  verb->add_option("--sweeps", o->sweeps, "at most so many sweeps, instead of the scene's")
      ->check(whole_number(1));
  verb->add_option("--random", o->random, "so many random networks on random arrays")->check(whole_number(1));
  verb->add_option("--seed", o->seed, "of the first random network")
      ->check(whole_number(0, INT64_MAX))
      ->capture_default_str();
  verb->add_option("--out", o->out, "the file to write (docs/use/test-vectors.md describes it)");
  verb->add_flag("--blank", o->blank, "without answers: a core fills them in");
  verb->add_option("--check", o->check, "judge a file that was filled in");
  verb->add_option("--level", o->level,
                   fmt::format("{}: whose answers count",
                               fmt::join(levels::level_names({levels::Kind::array}), " | ")))
      ->capture_default_str();
  verb->footer("Example:\n  hopmesh vectors two-nodes --step 3 --out out/two-nodes.txt\n"
               "Exit: 0 done, all right; 1 a wrong answer (which is told); 2 bad input.");
  verb->callback([o, &exit_code] { exit_code = vectors(*o); });
}

} // namespace hopmesh::cli
