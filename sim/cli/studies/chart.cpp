// hopmesh chart: results.csv as a picture of speed against accuracy.
#include "sim/cli/options.h"
#include "sim/study/result_chart.h"

#include <fmt/format.h>

namespace hopmesh::cli {

void add_chart(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<study::ChartOrder>();
  CLI::App* verb = program.add_subcommand("chart", "speed against accuracy, from the results of a sweep");
  verb->add_option("DIR", o->folder, "the results folder of a sweep")->required();
  verb->add_option("--x", o->x,
                   "column for the error (the last truth_error@ that is known, or the next best)");
  verb->add_option("--y", o->y,
                   "column for the work (hardware_seconds; host_seconds where integrators compete)");
  verb->add_option("--over", o->over,
                   "AXIS,...: points equal in all other axes are one mark at the median, with bars from the "
                   "least to the largest, and a row of spread.csv")
      ->delimiter(',');
  verb->add_option("--out", o->out, "folder for chart.svg, report.html, spread.csv (DIR)");
  verb->footer("Example:\n  hopmesh chart out/first-widths --x output_error --y cycles\n"
               "(after hopmesh sweep first-widths --out out/first-widths)");
  verb->callback([o, &exit_code] {
    fmt::print("{}", study::draw_chart(*o));
    exit_code = done;
  });
}

} // namespace hopmesh::cli
