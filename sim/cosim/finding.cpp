#include "sim/cosim/finding.h"

#include "sim/run/children.h"

#include <fmt/format.h>

namespace hopmesh::cosim {

namespace {

constexpr unsigned trial_seconds = 60;

} // namespace

bool differs_in_child(const std::vector<Contestant>& contestants, const ArrayJob& job) {
  return !run::run_in_child([&] { return contest(contestants, job).text.empty() ? 0 : 1; }, trial_seconds)
              .good();
}

std::vector<Contestant> involved(const std::vector<Contestant>& contestants, const Finding& finding) {
  if (finding.contestant == 0) return contestants;
  return {contestants[0], contestants[finding.contestant]};
}

namespace {

void comment_answers(VectorWriter& file, const Contestant& contestant, const ArrayJob& job,
                     const SharedBus& bus) {
  if (!bus) return;
  const Answer a = ask(*bus, job, true);
  file.comment(fmt::format("{}: end {} {:d} {} {}", contestant.name, a.end.sweeps, a.end.converged,
                           a.end.largest_change, a.end.cycles));
  for (std::size_t k = 0; k < a.outputs.size(); ++k)
    file.comment(fmt::format("{}: after sweep {} {}", contestant.name, k + 1, fmt::join(a.outputs[k], " ")));
}

int write_whole(const std::filesystem::path& path, const VectorCase& a_case,
                const std::vector<Contestant>& contestants, const std::vector<std::string>& comments) {
  std::vector<SharedBus> buses;
  for (const Contestant& c : contestants) buses.push_back(c.make(a_case.job));
  VectorWriter file(path);
  for (const std::string& line : comments) file.comment(line);
  for (std::size_t k = 0; k < contestants.size(); ++k)
    comment_answers(file, contestants[k], a_case.job, buses[k]);
  file.add(a_case, buses[0].get());
  file.commit();
  return 0;
}

} // namespace

void write_finding(const std::filesystem::path& path, const VectorCase& a_case,
                   const std::vector<Contestant>& contestants, const std::vector<std::string>& comments) {
  files::check_writable(std::filesystem::absolute(path).parent_path(), 1 << 20);
  const auto write = [&] { return write_whole(path, a_case, contestants, comments); };
  if (run::run_in_child(write, trial_seconds).good()) return;
  VectorWriter file(path); // whoever crashes, the case itself is kept
  for (const std::string& line : comments) file.comment(line);
  file.add(a_case, nullptr);
  file.commit();
}

} // namespace hopmesh::cosim
