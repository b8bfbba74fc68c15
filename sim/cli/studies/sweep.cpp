// hopmesh sweep: every point of a study, a row each.
#include "sim/cli/options.h"
#include "sim/cli/studies/study_run.h"

namespace hopmesh::cli {

void add_sweep(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<StudyOptions>();
  CLI::App* verb = program.add_subcommand("sweep", "a grid of scene and array settings, a row a point");
  add_study(*verb, *o);
  verb->footer("Example:\n  hopmesh sweep first-widths --out out/first-widths -j 2\n"
               "Exit: 0 done (points that diverge or crash are rows), 1 points are missing, 2 bad input, 130 "
               "interrupted (the same command goes on).");
  verb->callback([o, &exit_code] {
    std::filesystem::path folder;
    exit_code = run_study(*o, study::read_study(o->study), folder);
  });
}

} // namespace hopmesh::cli
