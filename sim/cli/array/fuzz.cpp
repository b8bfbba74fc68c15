// hopmesh fuzz: the differential campaign over all fixed levels.
#include "sim/cli/options.h"
#include "sim/cosim/campaign_arrays.h"
#include "sim/cosim/finding.h"
#include "sim/cosim/random_job.h"
#include "sim/input/count_text.h"
#include "sim/levels/interrupt.h"
#include "sim/run/children.h"
#include "sim/run/progress.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

using cosim::Ways;
using input::grouped;

struct FuzzOptions {
  std::vector<std::string> levels = levels::campaign_names(), arrays;
  double seconds = 0;
  std::uint64_t seed = 1, first = 0;
  std::int64_t cases = 0;
  int children = 1;
  std::string out = "out/fuzz", replay;
};

// In the table's order: the engine's first kernel takes any array, and leads where it takes part.
Ways ways_asked_for(const FuzzOptions& o) {
  for (const std::string& level : o.levels) levels::level_named(level, "--levels", {levels::Kind::array});
  std::vector<const levels::Level*> rows;
  for (const levels::Level& level : levels::levels())
    if (std::count(o.levels.begin(), o.levels.end(), level.name)) rows.push_back(&level);
  Ways all = levels::ways_of(rows);
  if (all.size() < 2)
    throw input::input_error("", 0, "--levels", o.levels[0] + " alone", "at least two levels");
  return all;
}

std::string command_of(const FuzzOptions& o, std::uint64_t first) {
  std::string command = fmt::format("hopmesh fuzz --seed {} --first {}", o.seed, first);
  if (o.cases > 0)
    command += fmt::format(" --cases {}", o.first + static_cast<std::uint64_t>(o.cases) - first);
  if (o.seconds > 0) command += fmt::format(" --seconds {:g}", o.seconds);
  if (o.levels != levels::campaign_names()) command += fmt::format(" --levels {}", fmt::join(o.levels, ","));
  if (!o.arrays.empty()) command += fmt::format(" --arrays {}", fmt::join(o.arrays, ","));
  return command;
}

// Small enough to be read, in a file that shows it again.
int tell_finding(const FuzzOptions& o, const Ways& all, const cosim::CampaignPlan& plan,
                 const cosim::Finding& finding) {
  fmt::print("case {} of seed {}: {}\n", finding.number, o.seed, finding.text);
  const std::filesystem::path file =
      std::filesystem::path(o.out) / fmt::format("seed-{}-case-{}.txt", o.seed, finding.number);
  const std::string again = "hopmesh fuzz --replay " + input::shell_word(file.string());
  const cosim::KeptFinding kept = cosim::keep_finding(
      file, all, plan, finding, {"found by: " + command_of(o, finding.number), "again: " + again});
  if (!kept.repeats) fmt::print("by itself the case does not differ; it is kept as it is\n");
  fmt::print("smallest that still differs: {}\n  {}\n  {}\n", cosim::describe(kept.job), file.string(),
             again);
  return differs;
}

int campaign(const FuzzOptions& o, const Ways& all) {
  cosim::CampaignPlan plan;
  plan.seed = o.seed, plan.first = o.first, plan.children = static_cast<std::size_t>(o.children);
  if (o.cases > 0) plan.cases = static_cast<std::uint64_t>(o.cases);
  if (o.seconds > 0) plan.seconds = o.seconds;
  if (o.cases == 0 && o.seconds == 0) plan.seconds = 10;
  std::vector<std::string> notes;
  plan.arrays = cosim::campaign_arrays(o.levels, o.arrays, notes);
  tell(notes);
  levels::catch_interrupts();
  cosim::CampaignResult r;
  {
    run::CountProgress progress("cases", o.cases > 0 ? plan.cases : 0);
    r = cosim::run_campaign(
        all, plan, [&](std::uint64_t cases) { progress.count(cases); }, levels::stop_requested);
  }
  const double rate = r.seconds > 0 ? static_cast<double>(r.cases) / r.seconds : 0;
  fmt::print("seed {}, cases {} to {}: {} equal, {} different; {:.1f} s of wall time, {:.0f} cases/s\n",
             o.seed, o.first, r.next, grouped(r.cases), r.finding ? 1 : 0, r.seconds, rate);
  if (r.finding) return tell_finding(o, all, plan, *r.finding);
  if (!r.interrupted) return done;
  fmt::print("interrupted; to go on: {}\n", command_of(o, r.next));
  return interrupted;
}

int replay(const FuzzOptions& o, const Ways& all) {
  cosim::VectorReader reader(o.replay);
  cosim::VectorCase a_case;
  std::uint64_t cases = 0, different = 0;
  for (; reader.next(a_case); ++cases) {
    if (!cosim::differs_in_child(all, a_case.job)) continue;
    different += 1;
    fmt::print("case {}: ", a_case.name);
    const auto tell_difference = [&] { return fmt::print("{}\n", cosim::contest(all, a_case.job).text), 0; };
    const run::ChildEnd end = run::run_in_child(tell_difference, 60);
    if (!end.good()) fmt::print("one of the levels crashes ({})\n", end.signal ? end.signal : end.exit_code);
  }
  if (cases == 0) throw input::input_error(o.replay, 0, "", "no case", "case NAME");
  fmt::print("{}: {} of {} cases differ\n", o.replay, different, cases);
  return different > 0 ? differs : done;
}

int fuzz(const FuzzOptions& o) {
  const Ways all = ways_asked_for(o);
  return o.replay.empty() ? campaign(o, all) : replay(o, all);
}

} // namespace

void add_fuzz(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<FuzzOptions>();
  CLI::App* verb = program.add_subcommand("fuzz", "random networks on random arrays: do all levels agree?");
  verb->add_option("--seconds", o->seconds, "no case is begun after so many (10, where --cases is not given)")
      ->check(number_in(0.001, 1e9));
  verb->add_option("--cases", o->cases, "so many cases")->check(whole_number(1));
  verb->add_option("--seed", o->seed, "seed and number make a case, on any machine")
      ->check(whole_number(0, INT64_MAX))
      ->capture_default_str();
  verb->add_option("--first", o->first, "the first case: how a campaign is gone on with")
      ->check(whole_number(0, INT64_MAX))
      ->capture_default_str();
  verb->add_option("--levels", o->levels,
                   fmt::format("{}, each in all its ways of computing",
                               fmt::join(levels::level_names({levels::Kind::array}), ", ")))
      ->delimiter(',');
  verb->add_option("--arrays", o->arrays,
                   "random networks on these arrays, presets or files, instead of random arrays")
      ->delimiter(',');
  verb->add_option("-j", o->children, "processes at once; changes no case")->check(whole_number(1, 256));
  verb->add_option("--out", o->out, "folder for a case that differs, made as small as it gets")
      ->capture_default_str();
  verb->add_option("--replay", o->replay, "the cases of a file of vectors instead of random ones");
  verb->footer(
      "Example:\n  hopmesh fuzz --seconds 2 --seed 1\n"
      "Exit: 0 all agree, 1 they do not (the case is shrunk and written), 2 bad input, 130 interrupted.");
  verb->callback([o, &exit_code] { exit_code = fuzz(*o); });
}

} // namespace hopmesh::cli
