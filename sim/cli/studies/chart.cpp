// hopmesh chart: results.csv as a picture of speed against accuracy.
#include "sim/cli/options.h"
#include "sim/study/result_chart.h"

#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct ChartOptions {
  std::string folder, x, y;
};

int chart(const ChartOptions& o) {
  const std::filesystem::path folder = o.folder;
  const study::ChartDrawn drawn = study::draw_chart(folder, o.x, o.y);
  fmt::print("{} points: {} against {}\nResults\n  {}\n  {}\n", drawn.points, drawn.y, drawn.x,
             (folder / "chart.svg").string(), (folder / "report.html").string());
  return done;
}

} // namespace

void add_chart(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<ChartOptions>();
  CLI::App* verb = program.add_subcommand("chart", "speed against accuracy, from the results of a sweep");
  verb->add_option("DIR", o->folder, "the results folder of a sweep")->required();
  verb->add_option("--x", o->x,
                   "column for the error (the last truth_error@ that is known, or the next best)");
  verb->add_option("--y", o->y, "column for the work (array_seconds, else host_seconds)");
  verb->footer("Example:\n  hopmesh chart out/first-widths --x output_error --y cycles\n"
               "(after hopmesh sweep first-widths --out out/first-widths)");
  verb->callback([o, &exit_code] { exit_code = chart(*o); });
}

} // namespace hopmesh::cli
