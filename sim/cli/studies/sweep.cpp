// hopmesh sweep: every point of a study, a row each.
#include "sim/cli/options.h"
#include "sim/cli/studies/study_options.h"

#include <fmt/format.h>

namespace hopmesh::cli {

void add_sweep(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<StudyOptions>();
  CLI::App* verb = program.add_subcommand("sweep", "a grid of scene and array settings, a row a point");
  add_study(*verb, *o);
  verb->footer("Example:\n  hopmesh sweep first-widths --out out/first-widths -j 2\n"
               "Exit: 0 done (points that diverge or crash are rows), 1 points are missing, 2 bad input, 130 "
               "interrupted (the same command goes on).");
  verb->callback([o, &exit_code] {
    const study::Study study = study::read_study(o->study);
    const study::StudyEnd end = study::run_study(study, order_of(*o, study));
    fmt::print("{}", end.text);
    exit_code = exit_of(end.outcome);
  });
}

} // namespace hopmesh::cli
