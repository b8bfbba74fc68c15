// hopmesh stability: a study over two numeric axes, each cell a class.
#include "sim/cli/options.h"
#include "sim/cli/studies/study_options.h"
#include "sim/study/stability_map.h"

#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

int stability(const StudyOptions& o) {
  const study::Study study = study::read_study(o.study);
  study::check_map(study); // before hours of work
  const study::StudyOrder order = order_of(o, study);
  const study::StudyEnd end = study::run_study(study, order);
  fmt::print("{}", end.text);
  if (end.outcome == run::Outcome::finished && study::draw_map(order.folder, study))
    fmt::print("  {}\n  {}\n", (order.folder / "stability.csv").string(),
               (order.folder / "stability.svg").string());
  return exit_of(end.outcome);
}

} // namespace

void add_stability(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<StudyOptions>();
  CLI::App* verb = program.add_subcommand("stability", "where each method fails: a class a cell");
  add_study(*verb, *o);
  verb->footer("Example:\n  hopmesh stability first-map --out out/first-map -j 2\n"
               "The first two axes of numbers span the map; methods and other axes are panels side by side.");
  verb->callback([o, &exit_code] { exit_code = stability(*o); });
}

} // namespace hopmesh::cli
