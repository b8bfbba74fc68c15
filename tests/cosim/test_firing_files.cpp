// Files of firings: what is written comes back, whoever reads it, and the judge names the stage that somebody
// changed, in every form of a file.
#include "sim/cosim/firings/edge_search.h"
#include "sim/cosim/firings/firing_edges.h"
#include "sim/cosim/firings/firing_judge.h"
#include "sim/cosim/firings/memory_image.h"
#include "sim/input/input_error.h"
#include "tests/support/complaint.h"
#include "tests/support/files.h"

#include "place.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace cosim;
using ::testing::HasSubstr;

constexpr std::size_t taps = 5;

/// An array with something in every column.
NeuronShape some_shape() {
  spec::ArraySpec array;
  array.lanes = 2;
  array.exact_accumulator = false;
  array.formats.accumulator = {30, 6, spec::Rounding::rnd_conv, spec::Overflow::sat};
  return {array, taps};
}

std::vector<Firing> some_firings(const NeuronShape& shape) {
  const auto neuron = levels::default_level().open_neuron(shape.array, shape.taps);
  std::vector<Firing> all = edge_firings(shape, neuron);
  Dice dice(3);
  for (int k = 0; k < 40; ++k) {
    all.push_back(fired(shape, neuron, random_inputs(dice, shape, neuron)));
    all.back().neuron = all.size() - 1;
  }
  return all;
}

class FiringFiles : public testing::TestWithParam<FiringFormat> {
 protected:
  FiringFiles() : shape(some_shape()), firings(some_firings(shape)) {}

  void write(bool blank = false) const {
    const auto writer = make_firing_writer(GetParam(), path(), shape, {"some", blank});
    for (const Firing& f : firings) writer->add(f);
    writer->commit();
  }
  std::string path() const { return folder / "f"; }
  FiringsJudged judged() const { return judge_firings(path(), levels::default_level()); }

  const Folder folder;
  const NeuronShape shape;
  std::vector<Firing> firings;
};

TEST_P(FiringFiles, comeBackAsTheyWere) {
  write();
  const auto reader = open_firings(path());
  EXPECT_EQ(reader->shape().taps, taps);
  EXPECT_EQ(reader->shape().formats.accumulator, shape.formats.accumulator);
  FiringRow row;
  for (const Firing& f : firings) {
    ASSERT_TRUE(reader->next(row));
    EXPECT_EQ(row, row_of(f, shape));
    EXPECT_FALSE(row_fault(row, shape));
    const Firing back = firing_of(row);
    EXPECT_EQ(back.inputs.weight, f.inputs.weight);
    EXPECT_EQ(back.inputs.link, f.inputs.link);
  }
  EXPECT_FALSE(reader->next(row));
  const FiringsJudged all = judged();
  EXPECT_EQ(all.wrong, "");
  EXPECT_EQ(all.firings, firings.size());
  EXPECT_THAT(all.told, testing::ElementsAre("s", "N", "r", "u before the limiter", "u", "R", "product", "dV",
                                             "V", "Y", "link"));
  EXPECT_THAT(all.untold, testing::IsEmpty());
}

/// An answer of one firing is changed, and only that.
void change(Firing& f, const std::string& column, std::int64_t more) {
  spec::FiringSteps& s = f.steps;
  if (column == "sum") s.sum[2] += more;
  if (column == "norm") s.norm += more;
  if (column == "reciprocal") s.reciprocal += more;
  if (column == "places") s.places += more;
  if (column == "ratio") s.ratio += more;
  if (column == "drive") s.drive += more;
  if (column == "pull") s.pull += more;
  if (column == "product") s.product += more;
  if (column == "change") s.change += more;
  if (column == "state_after") s.state += static_cast<std::int32_t>(more);
  if (column == "extrapolated_after") s.extrapolated += static_cast<std::int32_t>(more);
  if (column == "link_after") s.link += static_cast<std::int32_t>(more);
}

TEST_P(FiringFiles, areJudgedByTheStageThatWasChanged) {
  std::size_t at = firings.size() - 1; // a full row with no number at an end of its range
  const auto inside = [](std::int64_t code, std::int64_t end) { return std::abs(code) < end - 3; };
  while (firings[at].inputs.weight.size() < taps || firings[at].steps.norm < 100 ||
         !inside(firings[at].steps.sum[2], shape.formats.accumulator.max_raw()) ||
         !inside(firings[at].steps.state, shape.formats.state.one_raw()) || firings[at].steps.pull < 3)
    --at;
  for (const FiringColumn& column : firing_columns()) {
    if (column.part != Part::answer) continue;
    for (std::int64_t more : {1, -3}) {
      const Firing kept = firings[at];
      change(firings[at], column.name, more);
      write();
      firings[at] = kept;
      const std::string wrong = judged().wrong;
      EXPECT_THAT(wrong, HasSubstr("firing " + std::to_string(at) + ": " + column.stage +
                                   " is wrong first (" + column.name));
      EXPECT_THAT(wrong, HasSubstr(more > 0 ? ": 1 last place too high\n" : ": 3 last places too low\n"));
    }
  }
}

TEST_P(FiringFiles, nameTheEarliestStageOfTheFirstWrongFiring) {
  change(firings[9], "link_after", 1);
  change(firings[9], "drive", 2);
  change(firings[9], "norm", 5);
  change(firings[12], "sum", 1);
  write();
  EXPECT_THAT(judged().wrong, HasSubstr("firing 9: N is wrong first (norm): "));
  EXPECT_THAT(judged().wrong, HasSubstr("5 last places too high\n  right before it: s; edges: "));
}

TEST_P(FiringFiles, thatAreBlankAreNoAnswers) {
  write(true);
  EXPECT_THAT(complaint([&] { judged(); }), HasSubstr("found no answer, expected answers: this line was "
                                                      "not filled in"));
}

TEST_P(FiringFiles, areRefusedWhereAnInputIsOutOfRange) {
  firings[4].inputs.state = static_cast<std::int32_t>(shape.formats.state.one_raw()) + 1;
  write();
  EXPECT_THAT(complaint([&] { judged(); }), HasSubstr("found state 4194305, expected at most 4194304"));
}

INSTANTIATE_TEST_SUITE_P(As, FiringFiles,
                         testing::Values(FiringFormat::text, FiringFormat::csv, FiringFormat::memh),
                         [](const auto& made) {
                           return std::string(firing_format_names[static_cast<std::size_t>(made.param)]);
                         });

TEST(MemoryImage, isReadAsVerilogHasIt) {
  const Folder folder;
  const auto read = [&](const std::string& text, int bits = 8, bool negative = true) {
    return read_memory(folder.write("m.memh", text), 6, bits, negative);
  };
  const std::vector<Cell> words{1, -1, 127, -128, std::nullopt, 5};
  EXPECT_EQ(read("01 FF // two\n7f\n/* a\nblock */ 8_0\nxx 05\n"), words);
  EXPECT_EQ(read("// 0x00000000\n01\nff\n7f\n80\n@5\n05\n"), words);
  EXPECT_EQ(read("ff", 8, false)[0], 255);
  EXPECT_EQ(memory_word(-1, 9), "1ff");
  EXPECT_EQ(memory_word(5, 43), "00000000005");
  EXPECT_EQ(memory_word(INT64_MIN, 64), "8000000000000000");
  EXPECT_THAT(complaint([&] { read("01\n1ff\n"); }),
              HasSubstr("m.memh:2: found \"1ff\", expected a word of 8 bits"));
  EXPECT_THAT(complaint([&] { read("1 2 3 4 5 6 7"); }),
              HasSubstr("found a word for address 6, expected 6 words"));
  EXPECT_THAT(complaint([&] { read("12 0g"); }), HasSubstr("expected hexadecimal digits"));
  EXPECT_THAT(complaint([&] { read("@"); }), HasSubstr("expected hexadecimal digits"));
}

TEST(FiringPage, tellsEveryColumnAndEveryEdge) {
  std::vector<std::string> rows;
  for (const std::string& line : lines_of(content_of(HOPMESH_SOURCE_DIR "/docs/use/test-vectors.md")))
    if (line.rfind("| `", 0) == 0) rows.push_back(line);
  const auto expect_row = [&](const std::string& name, const std::string& meaning) {
    EXPECT_EQ(std::count_if(rows.begin(), rows.end(),
                            [&](const std::string& row) {
                              return row.rfind("| `" + name + "` |", 0) == 0 &&
                                     row.find("| " + meaning + " |") != std::string::npos;
                            }),
              1)
        << name << ": " << meaning;
  };
  for (const FiringColumn& column : firing_columns()) expect_row(column.name, column.meaning);
  for (const EdgeWords& edge : firing_edges()) expect_row(edge.name, edge.meaning);
}

} // namespace
} // namespace hopmesh::tests
