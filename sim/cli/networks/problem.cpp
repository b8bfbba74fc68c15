// hopmesh problem: one of the problem set, written as Matrix Market files.
#include "sim/networks/problems/problem.h"

#include "sim/cli/options.h"
#include "sim/files/output_file.h"
#include "sim/input/count_text.h"
#include "sim/run/array_info.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct ProblemRequest {
  std::string name, out;
  std::int64_t seed = 1;
};

int problem(const ProblemRequest& o) {
  check_problem(o.name, "NAME");
  const problems::Problem p = problems::make(o.name, static_cast<std::uint64_t>(o.seed));
  const std::filesystem::path folder(o.out);
  files::check_writable(folder, p.W.entries.size() * 40 + p.bias.size() * 50);
  files::write_matrix(folder / "W.mtx", p.W.rows, p.W.columns, p.W.entries);
  files::write_vector(folder / "bias.mtx", p.bias);
  files::write_vector(folder / "V0.mtx", p.start);
  fmt::print("{}: {}; {} weights; written to {}\n", p.name, problems::about(p.name),
             input::grouped(p.W.entries.size()), o.out);
  return done;
}

} // namespace

void check_problem(const std::string& name, const std::string& where) {
  const auto& names = problems::names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw input::input_error("", 0, where, input::in_quotes(name),
                             "a file, or a problem that `hopmesh problems` lists",
                             input::nearest_name(name, names));
}

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
