// hopmesh rtl: the array of a scene as Verilog.
#include "sim/cli/options.h"
#include "sim/input/count_text.h"
#include "sim/run/design/rtl_design.h"

#include <fmt/format.h>
#include <numeric>

namespace hopmesh::cli {

namespace {

struct RtlOrder {
  input::InputWords words;
  std::string out;
  std::int64_t steps = 2;
};

int rtl(const RtlOrder& o) {
  const levels::Prepared p = prepare(o.words);
  const std::filesystem::path folder = results_folder(o.out, p.inputs.scene.name + "-rtl");
  const run::DesignFacts facts = run::write_rtl_design(p, static_cast<std::size_t>(o.steps), folder);
  const std::uint64_t cycles = std::accumulate(facts.cycles.begin(), facts.cycles.end(), std::uint64_t{0});
  fmt::print("{}: the array \"{}\" in Verilog, {} files\n", folder.string(), p.inputs.array.name,
             facts.files);
  fmt::print("  the test bench plays {} step{}: {} array cycles\n", o.steps, o.steps == 1 ? "" : "s",
             input::grouped(cycles));
  return done;
}

} // namespace

void add_rtl(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<RtlOrder>();
  CLI::App* verb = program.add_subcommand("rtl", "the array as Verilog that stands alone, with a test bench");
  add_common(*verb, o->words);
  verb->add_option("--out", o->out, "folder of the design (out/NAME-rtl)");
  verb->add_option("--steps", o->steps, "steps of the motion that the test bench plays")
      ->check(whole_number(0, 1000))
      ->capture_default_str();
  verb->footer("Example:\n  hopmesh rtl two-nodes --array folded --out out/two-nodes-rtl");
  verb->callback([o, &exit_code] { exit_code = rtl(*o); });
}

} // namespace hopmesh::cli
