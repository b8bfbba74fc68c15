// hopmesh vectors: jobs and answers for a core that is not ours, and the judge of what it answered.
#include "sim/cli/array/vectors_options.h"
#include "sim/input/count_text.h"
#include "sim/levels/interrupt.h"

#include <fmt/format.h>

namespace hopmesh::cli {

void refuse(const char* flag, const std::string& found, const std::string& expected) {
  throw input::input_error("", 0, flag, found, expected);
}

std::optional<cosim::VectorCase> step_case(const VectorsOptions& o) {
  std::string ending;
  auto step = cosim::case_of_step(prepare(with_steps(o.words, o.step + 1)),
                                  static_cast<std::uint64_t>(o.step), ending);
  if (!step) fmt::print("{}\n", ending);
  if (step && o.sweeps > 0) step->job.max_sweeps = static_cast<std::uint32_t>(o.sweeps);
  return step;
}

namespace {

using input::grouped;

// A single source: a scene's step, random cases, or a file to judge; and no flag that belongs to another.
void check_options(const VectorsOptions& o) {
  const int sources = !o.words.scene.empty() + (o.random > 0) + !o.check.empty();
  if (sources != 1)
    refuse("vectors", sources == 0 ? "nothing to do" : "several sources",
           "one of SCENE --step K, --random N, or --check FILE");
  if (o.words.scene.empty() != (o.step < 0))
    refuse("--step", o.step < 0 ? "none" : "no scene", "SCENE --step K");
  const bool has_array = !o.words.array.empty() || !o.words.overrides.empty();
  if (o.words.scene.empty() && (o.sweeps > 0 || (has_array && !(o.neurons && o.random > 0))))
    refuse("vectors", "--array, --set or --sweeps without a scene", "SCENE");
  if (o.check.empty() == o.out.empty())
    refuse("--out", o.out.empty() ? "none" : "a file beside --check",
           "a file for the vectors, or --check FILE");
  if (o.blank && !o.check.empty()) refuse("--blank", "a file beside --check", "--out FILE");
  levels::level_named(o.level, "--level", {levels::Kind::array});
  check_neuron_options(o);
}

int write_vectors(const VectorsOptions& o) {
  std::uint64_t cases = static_cast<std::uint64_t>(o.random);
  cosim::CaseMaker make = [&](std::uint64_t k) { return cosim::random_case(o.seed + k); };
  if (!o.words.scene.empty()) {
    auto step = step_case(o);
    if (!step) return levels::stop_requested ? interrupted : differs;
    cases = 1, make = [a_case = std::move(*step)](std::uint64_t) { return a_case; };
  }
  const levels::Level& level = levels::level_named(o.level, "--level");
  if (!cosim::write_vectors(o.out, cases, make, o.blank ? nullptr : &level)) return interrupted;
  fmt::print("{}: {} cases, {}\n", o.out, grouped(cases),
             o.blank ? "without answers" : "answers by level " + o.level);
  return done;
}

int judge_vectors(const VectorsOptions& o) {
  const cosim::VectorsJudged judged = cosim::judge_vectors(o.check, levels::level_named(o.level, "--level"));
  if (judged.interrupted) return interrupted;
  if (judged.wrong.empty())
    fmt::print("{}: {} cases, {} lines of answers, all right (level {})\n", o.check, grouped(judged.cases),
               grouped(judged.lines), o.level);
  else
    fmt::print("{}\n", judged.wrong);
  return judged.wrong.empty() ? done : differs;
}

int vectors(const VectorsOptions& o) {
  check_options(o);
  levels::catch_interrupts();
  try {
    if (o.neurons) return o.check.empty() ? write_neurons(o) : judge_neurons(o);
    return o.check.empty() ? write_vectors(o) : judge_vectors(o);
  } catch (const levels::Stopped&) {
    return interrupted;
  }
}

} // namespace

void add_vectors(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<VectorsOptions>();
  CLI::App* verb = program.add_subcommand(
      "vectors", "test vectors for a core that is not ours, and the judge of what it answered");
  add_common(*verb, o->words);
  verb->get_option("SCENE")->required(false);
  verb->add_option("--step", o->step, "the network of this step of SCENE, counted from 0")
      ->check(whole_number(0));
  verb->add_option("--sweeps", o->sweeps, "at most so many sweeps, instead of the scene's")
      ->check(whole_number(1));
  verb->add_option("--random", o->random,
                   "so many random networks on random arrays; with --neurons, random firings on --array")
      ->check(whole_number(1));
  verb->add_option("--seed", o->seed, "of the first random network, or of the random firings")
      ->check(whole_number(0, INT64_MAX))
      ->capture_default_str();
  verb->add_flag("--neurons", o->neurons, "of one neuron: a line a firing, with every number on the way");
  verb->add_option("--format", o->format,
                   "text | csv | memh: with --neurons, of the file; memh is a folder for $readmemh");
  verb->add_option("--taps", o->taps, "inputs of the longest random row; none: 27")
      ->check(whole_number(1, 4096));
  verb->add_option("--out", o->out, "the file to write (docs/use/test-vectors.md describes it)");
  verb->add_flag("--blank", o->blank, "without answers: a core fills them in");
  verb->add_option("--check", o->check, "judge a file that was filled in");
  verb->add_option("--level", o->level,
                   fmt::format("{}: whose answers count",
                               fmt::join(levels::level_names({levels::Kind::array}), " | ")))
      ->capture_default_str();
  verb->footer("Example:\n  hopmesh vectors two-nodes --step 3 --out out/two-nodes.txt\n"
               "  hopmesh vectors two-nodes --step 3 --neurons --out out/neurons.txt\n"
               "Exit: 0 done, all right; 1 a wrong answer (which is told); 2 bad input.");
  verb->callback([o, &exit_code] { exit_code = vectors(*o); });
}

} // namespace hopmesh::cli
