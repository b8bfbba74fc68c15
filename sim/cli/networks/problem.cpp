// hopmesh problem: one of the problem set, written as Matrix Market files.
#include "sim/networks/problems/problem.h"
#include "sim/cli/options.h"
#include "sim/input/count_text.h"

#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct ProblemRequest {
  std::string name, out;
  std::int64_t seed = 1;
};

int problem(const ProblemRequest& o) {
  problems::check_name(o.name, "NAME");
  const problems::Problem p = problems::make(o.name, static_cast<std::uint64_t>(o.seed));
  problems::write_problem(o.out, p);
  fmt::print("{}: {}; {} weights; written to {}\n", p.name, problems::about(p.name),
             input::grouped(p.W.entries.size()), o.out);
  return done;
}

} // namespace

void add_problem(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<ProblemRequest>();
  CLI::App* verb = program.add_subcommand("problem", "one of the problem set as files");
  verb->add_option("NAME", o->name, "a problem that `hopmesh problems` lists")->required();
  verb->add_option("--seed", o->seed, "of its start")->check(whole_number(1))->capture_default_str();
  verb->add_option("--out", o->out, "folder for W.mtx, bias.mtx, V0.mtx")->required();
  verb->footer("Example:\n  hopmesh problem queens-8 --out out/queens");
  verb->callback([o, &exit_code] { exit_code = problem(*o); });
}

} // namespace hopmesh::cli
