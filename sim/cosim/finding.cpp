#include "sim/cosim/finding.h"

#include "sim/cosim/shrink.h"
#include "sim/levels/interrupt.h"
#include "sim/run/children.h"
#include "sim/run/progress.h"

#include <fmt/format.h>

namespace hopmesh::cosim {

namespace {

constexpr unsigned trial_seconds = 60;

} // namespace

bool differs_in_child(const Ways& ways, const ArrayJob& job) {
  return !run::run_in_child([&] { return contest(ways, job).text.empty() ? 0 : 1; }, trial_seconds).good();
}

Ways involved(const Ways& ways, const Finding& finding) {
  if (finding.way == 0) return ways;
  return {ways[0], ways[finding.way]};
}

namespace {

void comment_answers(VectorWriter& file, const Way& way, const ArrayJob& job, levels::ArrayPort* array) {
  if (!array) return;
  const Answer a = ask(BusArray(array->bus(), job.topology), job, true);
  file.comment(fmt::format("{}: end {} {:d} {} {} {}", way.name, a.end.sweeps, a.end.converged,
                           a.end.largest_change, a.end.largest_sum, a.end.cycles));
  for (std::size_t k = 0; k < a.outputs.size(); ++k)
    file.comment(fmt::format("{}: after sweep {} {}", way.name, k + 1, fmt::join(a.outputs[k], " ")));
}

int write_whole(const std::filesystem::path& path, const VectorCase& a_case, const Ways& ways,
                const std::vector<std::string>& comments) {
  std::vector<std::unique_ptr<levels::ArrayPort>> arrays;
  for (const Way& way : ways) arrays.push_back(way.make(a_case.job.array, a_case.job.topology));
  VectorWriter file(path);
  for (const std::string& line : comments) file.comment(line);
  for (std::size_t k = 0; k < ways.size(); ++k) comment_answers(file, ways[k], a_case.job, arrays[k].get());
  file.add(a_case, &arrays[0]->bus());
  file.commit();
  return 0;
}

} // namespace

void write_finding(const std::filesystem::path& path, const VectorCase& a_case, const Ways& ways,
                   const std::vector<std::string>& comments) {
  files::check_writable(std::filesystem::absolute(path).parent_path(), 1 << 20);
  const auto write = [&] { return write_whole(path, a_case, ways, comments); };
  if (run::run_in_child(write, trial_seconds).good()) return;
  VectorWriter file(path); // whoever crashes, the case itself is kept
  for (const std::string& line : comments) file.comment(line);
  file.add(a_case, nullptr);
  file.commit();
}

KeptFinding keep_finding(const std::filesystem::path& path, const Ways& ways, const CampaignPlan& plan,
                         const Finding& finding, const std::vector<std::string>& comments) {
  const Ways two = involved(ways, finding);
  const ArrayJob whole = campaign_case(plan.seed, finding.number, plan.arrays).job;
  run::CountProgress progress("smaller cases tried", 0);
  std::uint64_t tried = 0;
  const Differs still = [&](const ArrayJob& job) {
    progress.count(++tried);
    return !levels::stop_requested && differs_in_child(two, job);
  };
  const bool repeats = still(whole);
  KeptFinding kept{repeats ? shrink(whole, still) : whole, repeats};
  std::vector<std::string> lines = comments;
  lines.insert(lines.begin(), finding.text);
  write_finding(path, {fmt::format("seed {} case {}", plan.seed, finding.number), kept.job}, two, lines);
  return kept;
}

} // namespace hopmesh::cosim
