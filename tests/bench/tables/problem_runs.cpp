#include "tests/bench/tables/problem_runs.h"

#include "tests/support/files.h"

#include <cstdlib>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <sys/wait.h>

namespace hopmesh::bench {

using tests::content_of;

int ProblemRuns::run(const std::string& words) const {
  const int status = std::system(fmt::format("'{}' {} > /dev/null", program_, words).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

Solved ProblemRuns::solve(const std::string& what, const std::string& level, const std::string& more) const {
  const auto out = folder_ / ("of-" + level);
  const int code = run(fmt::format("solve {} --level {} {} --out '{}'", what, level, more, out.string()));
  if (code != 0 && code != 1) throw std::runtime_error(what + " at level " + level + " failed");
  const auto summary = nlohmann::json::parse(content_of(out / "summary.json"));
  return {summary["sweeps"], summary["cycles"],  summary["converged"],
          summary["energy"], summary["verdict"], content_of(out / "V.mtx")};
}

problems::Problem ProblemRuns::network(const std::string& scene, int step, std::string& what) const {
  problems::Problem p;
  p.name = fmt::format("{} step {}", scene, step);
  const auto out = folder_ / fmt::format("{}-{}", scene, step);
  if (run(fmt::format("network {} --step {} --out '{}'", scene, step, out.string())) != 0)
    throw std::runtime_error("no network of " + p.name);
  p.W = files::read_matrix((out / "W.mtx").string());
  p.bias = files::read_vector((out / "bias.mtx").string());
  p.start = files::read_vector((out / "V0.mtx").string());
  what = fmt::format("'{0}/W.mtx' '{0}/bias.mtx' --start '{0}/V0.mtx'", out.string());
  return p;
}

std::string ProblemRuns::written(const problems::Problem& p) const {
  const auto out = folder_ / "written";
  std::filesystem::create_directories(out);
  files::write_matrix(out / "W.mtx", p.W.rows, p.W.columns, p.W.entries);
  files::write_vector(out / "bias.mtx", p.bias);
  files::write_vector(out / "V0.mtx", p.start);
  return fmt::format("'{0}/W.mtx' '{0}/bias.mtx' --start '{0}/V0.mtx'", out.string());
}

} // namespace hopmesh::bench
