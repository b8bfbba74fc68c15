// Pictures of a machine and of its time: bars as long as what they stand for, figures of the description.
#include "rtl_model/spec/presets.h"
#include "sim/cosim/random_job.h"
#include "sim/machine/machine_picture.h"
#include "sim/machine/timeline_picture.h"

#include <gmock/gmock.h>
#include <map>
#include <regex>

namespace hopmesh::tests {
namespace {

using machine::machine_picture;
using ::testing::HasSubstr;
using ::testing::Not;

struct Bar {
  double x = 0, width = 0, height = 0;
};

/// By the words that a mouse sees; of several, the first.
std::map<std::string, Bar> bars_of(const std::string& svg) {
  static const std::regex shape("class=\"part\" x=\"([^\"]*)\" y=\"[^\"]*\" width=\"([^\"]*)\" "
                                "height=\"([^\"]*)\"[^>]*><title>([^<]*)<");
  std::map<std::string, Bar> bars;
  for (std::sregex_iterator at(svg.begin(), svg.end(), shape), end; at != end; ++at)
    bars.try_emplace((*at)[4], Bar{std::stod((*at)[1]), std::stod((*at)[2]), std::stod((*at)[3])});
  return bars;
}

machine::Timeline timeline(std::uint64_t bus, std::uint64_t prepare, std::uint64_t sweeps) {
  return {bus, prepare, sweeps, 10, 2 * sweeps};
}

TEST(TimelinePicture, LanesAreAsLongAsTheirCycles) {
  machine::TimelineView view{"Time", "", "Step 3", 1, 100, timeline(300, 100, 600), "All", {}, 100};
  view.motion = timeline(500, 0, 1500);
  const std::string svg = svg_of(view);
  const auto bars = bars_of(svg);
  const Bar load = bars.at("bus: load and start: 200 cycles"),
            prepare = bars.at("array: prepare: 100 cycles"), sweeps = bars.at("array: sweeps: 600 cycles"),
            read = bars.at("bus: read back: 100 cycles");
  EXPECT_NEAR(load.width, 2 * prepare.width, 0.2);
  EXPECT_NEAR(sweeps.width, 6 * prepare.width, 0.4);
  EXPECT_NEAR(read.width, prepare.width, 0.2);
  EXPECT_NEAR(prepare.x, load.x + load.width, 0.2);
  EXPECT_NEAR(sweeps.x, prepare.x + prepare.width, 0.2);
  EXPECT_NEAR(read.x, sweeps.x + sweeps.width, 0.2);
  const Bar busy = bars.at("multipliers: 20 % of them multiply while the array sweeps");
  EXPECT_NEAR(busy.height, 0.2 * sweeps.height, 0.1);
  EXPECT_NEAR(busy.width, sweeps.width, 0.2);
  EXPECT_NEAR(3 * bars.at("bus 25 %").width, bars.at("sweeps 75 %").width, 0.4);
  EXPECT_NEAR(bars.at("multiply 15 %").width * 85, bars.at("wait 85 %").width * 15, 20);
  EXPECT_THAT(svg, HasSubstr("how long that takes is not known")) << "the host is no idle of 0 cycles";
}

TEST(TimelinePicture, EachRunOfAStepIsDrawn) {
  machine::TimelineView view{"Time", "", "Step 3", 3, 90, timeline(300, 90, 600), "All", {}, 100};
  const auto count = [](const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count(svg_of(view), "array: sweeps: 600"), 3u);
  view.runs = 1000;
  EXPECT_EQ(count(svg_of(view), "array: sweeps: 600"), 1u) << "so many are drawn as one";
}

TEST(TimelinePicture, NothingDoneIsNoTrouble) {
  EXPECT_THAT(machine::svg_of({"Time", "", "", 1, 0, {}, "All 0 steps", {}, 100}), Not(HasSubstr("nan")));
}

TEST(MachinePicture, FollowsTheDescription) {
  const spec::Topology square = cosim::grid_topology(2, 2, true);
  spec::ArraySpec array = spec::folded_array();
  EXPECT_THAT(machine_picture(array, square, "a <square>"), HasSubstr("a &lt;square&gt;"));
  array.elements = 3, array.stages = spec::Stages::each, array.schedule = spec::Schedule::synchronous;
  const std::string each = machine_picture(array, square, "square");
  for (const char* figure :
       {"3 elements", "one each", "in two banks", "144 × 16 bits", "a write for each stage"})
    EXPECT_THAT(each, HasSubstr(figure));
  array = spec::byte_array();
  EXPECT_THAT(machine_picture(array, square, "square"), HasSubstr("u = s / N"));
  array.output = spec::Output::binary;
  const std::string binary = machine_picture(array, square, "square");
  EXPECT_THAT(binary, HasSubstr("u is the sign of s"));
  EXPECT_THAT(binary, Not(HasSubstr("R · u")));
  EXPECT_THAT(machine_picture(spec::prescaled_array(), square, "square"),
              HasSubstr("rows are divided by the host"));
}

} // namespace
} // namespace hopmesh::tests
