// hopmesh vectors: files for cores that are not ours, filled in by one (tests/other_core), and judged.
#include "tests/support/cli_test.h"

#include "place.h"

#include <regex>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;

class CliVectors : public Cli {
 protected:
  /// The other core fills a blank file in; `fault`: the output that it gets wrong, from 1.
  void fill_in(const std::string& blank, const std::string& filled, int fault = 0) const {
    std::string command = HOPMESH_OTHER_CORE " " + at(blank).string() + " " + at(filled).string();
    if (fault > 0) command += " " + std::to_string(fault);
    ASSERT_EQ(run_shell(command).exit_code, 0);
  }
  /// A file with every line from `from` on that begins with `key` passed through `change`, once.
  void change_line(const std::string& name, const std::string& key, const std::string& line) const {
    std::string text;
    bool changed = false;
    for (const std::string& old : lines_of(content_of(at(name)))) {
      const bool here = !changed && (old + '\n').rfind(key, 0) == 0;
      text += (here ? line : old) + "\n";
      changed = changed || here;
    }
    ASSERT_TRUE(changed) << key;
    write_text(at(name), text);
  }
  int line_of(const std::string& name, const std::string& key) const {
    int number = 0;
    for (const std::string& line : lines_of(content_of(at(name)))) {
      number += 1;
      if ((line + '\n').rfind(key, 0) == 0) return number;
    }
    return 0;
  }
};

TEST_F(CliVectors, AnotherCoreFillsInRandomCasesAndIsRight) {
  good("vectors --random 300 --seed 1000 --blank --out b.txt");
  fill_in("b.txt", "f.txt");
  EXPECT_THAT(good("vectors --check f.txt").out, HasSubstr("f.txt: 300 cases, "));
  const std::string text = content_of(at("b.txt"));
  for (const char* line : {"\noutput binary\n", "\noutput modified\n", "\noutput projected\n",
                           "\noutput momentum\n", "\nstop sum\n", "\nneurons_per_cell 1\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line;
}

TEST_F(CliVectors, AnotherCoreFillsInAStepOfAFlagOnEveryPreset) {
  for (const char* preset :
       {"guarded", "descent", "prescaled", "byte", "folded", "descent-projected", "descent-momentum",
        "guarded --set relax.stop=sum --set array.output=projected --set array.relaxation=20",
        "folded --set relax.stop=sum --set array.output=momentum --set array.schedule=synchronous",
        "byte --set array.output=momentum --set array.schedule=synchronous --set "
        "relax.momentum=[0.25,0.875]"}) {
    good(std::string("vectors flag-225 --step 1 --sweeps 5 --blank --out b.txt --array ") + preset);
    fill_in("b.txt", "f.txt");
    EXPECT_THAT(good("vectors --check f.txt --level systemc").out, HasSubstr("all right (level systemc)"));
  }
}

TEST_F(CliVectors, AFaultOfTheOtherCoreIsToldWithItsLineAndInputs) {
  good("vectors flag-225 --step 1 --sweeps 3 --array descent --blank --out b.txt");
  fill_in("b.txt", "right.txt");
  fill_in("b.txt", "wrong.txt", 1000);
  const auto right = lines_of(content_of(at("right.txt"))), wrong = lines_of(content_of(at("wrong.txt")));
  std::size_t line = 0;
  while (right.at(line) == wrong.at(line)) ++line;
  const Finished f = hopmesh("vectors --check wrong.txt");
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_EQ(f.err, "");
  const auto words = split(right[line], ' ');
  EXPECT_THAT(f.out, HasSubstr("wrong.txt:" + std::to_string(line + 1) + ": case flag-225 step 1, sweep " +
                               words[1] + ", phase " + words[2] + ", cycle " + words[3] + ", cell "));
  static const std::regex codes(R"(found (-?\d+), expected (-?\d+)\n)");
  std::smatch part;
  ASSERT_TRUE(std::regex_search(f.out, part, codes)) << f.out;
  EXPECT_EQ(std::stoi(part[1]), std::stoi(part[2]) + 1);
  EXPECT_THAT(f.out, HasSubstr("its inputs one update earlier:\n    cell "));
}

TEST_F(CliVectors, EveryLevelWritesTheSameAnswers) {
  good("vectors --random 20 --seed 5 --out engine.txt");
  good("vectors --random 20 --seed 5 --level systemc --out systemc.txt");
  good("vectors --random 20 --seed 5 --level systemc-clock --out clock.txt");
  EXPECT_TRUE(content_of(at("engine.txt")) == content_of(at("systemc.txt")));
  EXPECT_TRUE(content_of(at("engine.txt")) == content_of(at("clock.txt")));
  EXPECT_FALSE(content_of(at("engine.txt")).find("case random 5\n") == std::string::npos);
}

TEST_F(CliVectors, AStepIsWhatTheRunLoaded) {
  const auto table = read_table(results_of("two-nodes --steps 4", "r") / "steps.csv");
  good("vectors two-nodes --step 3 --out v.txt");
  const auto lines = lines_of(content_of(at("v.txt")));
  const auto end = split(lines.back(), ' ');
  EXPECT_EQ(end.at(0), "end");
  EXPECT_EQ(std::stod(end.at(1)), table.numbers("sweeps")[3]);
  EXPECT_EQ(std::stod(end.at(5)), table.numbers("cycles")[3]);
  const Array outputs = read_array(at("r") / "outputs_raw.npy");
  std::vector<double> last; // of each phase of the last sweep: one neuron each
  for (std::size_t k = lines.size() - 4; k + 1 < lines.size(); ++k)
    last.push_back(std::stod(split(lines[k], ' ').at(4)));
  const std::size_t row = outputs.values.size() / 4;
  EXPECT_EQ(last, std::vector<double>(outputs.values.end() - static_cast<std::ptrdiff_t>(row) + 3,
                                      outputs.values.end())); // node 1: node 0 is pinned
}

TEST_F(CliVectors, SetAndSweepsCount) {
  good("vectors two-nodes --step 1 --sweeps 2 --set array.lanes=3 --set relax.threshold=0 --out v.txt");
  const std::string text = content_of(at("v.txt"));
  for (const char* line : {"\nlanes 3\n", "\nmax_sweeps 2\n", "\nthreshold 0\n"})
    EXPECT_THAT(text, HasSubstr(line));
}

TEST_F(CliVectors, EveryKindOfWrongAnswerIsExitOne) {
  good("vectors two-nodes --step 3 --sweeps 4 --set relax.threshold=0 --out v.txt");
  const std::string whole = content_of(at("v.txt"));
  const auto expect_wrong = [&](const std::string& key, const std::string& line, const std::string& says) {
    write_text(at("v.txt"), whole);
    const int number = line_of("v.txt", key);
    change_line("v.txt", key, line);
    const Finished f = hopmesh("vectors --check v.txt");
    EXPECT_EQ(f.exit_code, 1) << f.err;
    EXPECT_THAT(f.out, HasSubstr("v.txt:" + std::to_string(number) + ": "));
    EXPECT_THAT(f.out, HasSubstr(says));
  };
  const auto line_with = [&](const std::string& key) {
    write_text(at("v.txt"), whole);
    return lines_of(whole).at(static_cast<std::size_t>(line_of("v.txt", key)) - 1);
  };
  expect_wrong("fire 1 0", "fire 1 0 29 5", "found 5, expected ");
  const auto words = split(line_with("fire 2 1"), ' ');
  expect_wrong("fire 2 1", "fire 2 1 59 " + words[4], "found cycle 59, expected 58");
  expect_wrong("end ", "end 4 0 9 0 999", "found end 4 0 9 0 999, expected end ");
  expect_wrong("fire 3 0", "end 2 1 0 0 67", "found the end after 2 sweeps, expected sweep 3 of ");
  write_text(at("v.txt"), whole);
  change_line("v.txt", "max_sweeps", "max_sweeps 1");
  const Finished f = hopmesh("vectors --check v.txt");
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_THAT(f.out, HasSubstr("found sweep 2, expected the end after 1 sweeps"));
}

struct Corruption {
  const char* name;
  const char* key;  ///< beginning of the line that is replaced
  const char* line; ///< "": the file ends here
  const char* says;
};

class CliVectorsFile : public CliVectors, public ::testing::WithParamInterface<Corruption> {};

TEST_P(CliVectorsFile, IsRefusedByNameAndLine) {
  good("vectors --random 2 --seed 8 --out v.txt");
  const Corruption& c = GetParam();
  const int number = line_of("v.txt", c.key);
  change_line("v.txt", c.key, c.line);
  if (*c.line == '\0') {
    std::string head;
    const auto lines = lines_of(content_of(at("v.txt")));
    for (int k = 0; k + 1 < number; ++k) head += lines[static_cast<std::size_t>(k)] + "\n";
    write_text(at("v.txt"), head);
  }
  for (const char* level : {"", " --level systemc"}) {
    const std::string err = refused(std::string("vectors --check v.txt") + level);
    const int told = *c.line == '\0' ? number - 1 : number;
    EXPECT_THAT(err, HasSubstr("hopmesh: v.txt:" + std::to_string(told) + ": "));
    EXPECT_THAT(err, HasSubstr(c.says));
  }
  const Finished f = hopmesh("fuzz --replay v.txt");
  if (std::string(c.key).find("fire") == 0 || std::string(c.key) == "end ")
    return; // answers: nobody asks there
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_THAT(f.err, HasSubstr("hopmesh: v.txt:"));
}

const std::vector<Corruption> corruptions{
    {"Header", "hopmesh-vectors", "hopmesh-vectors 1",
     "found \"hopmesh-vectors 1\", expected hopmesh-vectors 4"},
    {"Foreign", "hopmesh-vectors", "<html>", "expected hopmesh-vectors 4"},
    {"Case", "case ", "csae one", "expected case NAME (did you mean case?)"},
    {"CaseWithoutName", "case ", "case", "expected case NAME"},
    {"Schedule", "schedule ", "schedule colored",
     "coloured or sequential or synchronous (did you mean coloured?)"},
    {"Output", "output ", "output modfied",
     "output modified or binary or projected or momentum (did you mean modified?)"},
    {"Order", "lanes ", "bus_bits 32", "found \"bus_bits 32\", expected lanes N"},
    {"Lanes", "lanes ", "lanes 0", "lanes: found 0, expected 1 to 64"},
    {"LanesReal", "lanes ", "lanes 1.5", "found \"1.5\", expected lanes, an integer"},
    {"Bus", "bus_bits ", "bus_bits 48", "bus_bits: found 48, expected 32, 64 or 128"},
    {"Format", "weight ", "weight fixed<16,1,SC_RDN,SC_SAT>", "expected weight FORMAT, such as"},
    {"FormatRule", "drive ", "drive fixed<40,2>",
     "drive: found fixed<40,2,SC_TRN,SC_WRAP>, expected 4 to 32 bits"},
    {"Accumulator", "accumulator ", "accumulator wide", "accumulator exact, or accumulator FORMAT"},
    {"Cells", "cells ", "cells 0", "found \"0\", expected cells, an integer from 1 to"},
    {"CellsHuge", "cells ", "cells 99999999999", "expected cells, an integer from 1 to"},
    {"Neurons", "neurons_per_cell", "neurons_per_cell 4", "an integer from 1 to 3"},
    {"LinkBeyond", "links 0", "links 0 9999", "a neighbour in ascending order"},
    {"LinkToItself", "links 0", "links 0 0", "expected another cell"},
    {"LinkNumber", "links 1", "links 7", "expected links 1 and its neighbours"},
    {"Threshold", "threshold ", "threshold -1", "found \"-1\", expected threshold"},
    {"Sweeps", "max_sweeps ", "max_sweeps", "expected max_sweeps N"},
    {"Stop", "stop ", "stop sums", "found \"stop sums\", expected stop change or stop sum"},
    {"Share", "share ", "share 64", "found \"64\", expected share, an integer from 0 to 63"},
    {"SumThreshold", "sum_threshold ", "sum_threshold -1", "found \"-1\", expected sum_threshold"},
    {"Momentum", "momentum\n", "momentum 1 2 3 4 5 6 7",
     "7 words behind \"momentum\", expected momentum and"},
    {"Relaxation", "relaxation ", "relaxation 32", "relaxation: found 32, expected 1 to 31"},
    {"NeuronShort", "neuron 1 ", "neuron 1 0 0",
     "words behind \"neuron\", expected neuron 1, start, bias and"},
    {"Phases", "phases ", "phases 99", "by the schedule"},
    {"Phase", "phase 0", "phase 0 2", "by the schedule"},
    {"Answers", "answers", "answer", "expected answers"},
    {"FireOrder", "fire 1 1 ", "fire 1 2 9 9", "expected fire 1 1 CYCLE and"},
    {"FireWord", "fire 1 0 ", "fired 1 0 9", "(did you mean fire?)"},
    {"End", "end ", "end 1", "expected end SWEEPS CONVERGED LARGEST_CHANGE LARGEST_SUM CYCLES"},
    {"CutInTheNetwork", "neuron 1 ", "", "found the end of the file, expected neuron 1"},
    {"CutInTheAnswers", "fire 1 1 ", "", "found the end of the file, expected "},
};
INSTANTIATE_TEST_SUITE_P(Of, CliVectorsFile, ::testing::ValuesIn(corruptions),
                         [](const auto& made) { return made.param.name; });

TEST_F(CliVectors, ALinkMustLeadBothWays) {
  write_text(at("v.txt"), "");
  good("vectors flag-225 --step 0 --sweeps 1 --blank --out v.txt");
  const int number = line_of("v.txt", "links 0 ");
  change_line("v.txt", "links 0 ", "links 0");
  const Finished f = hopmesh("vectors --check v.txt");
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_THAT(f.err, HasSubstr("v.txt:" + std::to_string(number + 1) + ": links: found cell 1 linked to 0"));
}

TEST_F(CliVectors, ABlankCaseIsNoAnswer) {
  good("vectors --random 2 --seed 8 --blank --out b.txt");
  for (const char* level : {"engine", "systemc"}) {
    const Finished f = hopmesh(std::string("vectors --check b.txt --level ") + level);
    EXPECT_EQ(f.exit_code, 2);
    EXPECT_EQ(f.err, "hopmesh: b.txt:" + std::to_string(line_of("b.txt", "?")) +
                         ": found ?, expected answers: this case was not filled in\n");
  }
}

TEST_F(CliVectors, FilesThatAreNone) {
  write_text(at("empty.txt"), "");
  write_text(at("head.txt"), "hopmesh-vectors 4\n# nothing\n");
  write_text(at("binary.txt"), std::string("\x7f\x45\x4c\x46\0\1\2", 7));
  std::filesystem::create_directory(at("folder"));
  for (const auto& [name, says] :
       std::map<std::string, std::string>{{"empty.txt", "empty.txt: found an empty file"},
                                          {"head.txt", "found no case"},
                                          {"binary.txt", "binary.txt:1: found"},
                                          {"folder", "found a directory"},
                                          {"none.txt", "found no such file"}})
    for (const char* verb : {"vectors --check ", "fuzz --replay "}) {
      refused(verb + name, says);
    }
}

TEST_F(CliVectors, CommentsAndBlankLinesMayStandAnywhere) {
  good("vectors --random 3 --seed 2 --out v.txt");
  std::string text;
  for (const std::string& line : lines_of(content_of(at("v.txt")))) text += line + "\r\n\n  # a word\n";
  write_text(at("v.txt"), text);
  good("vectors --check v.txt");
}

TEST_F(CliVectors, NothingHalfWrittenIsLeft) {
  around.largest_file = 20000;
  const Finished f = hopmesh("vectors --random 300 --out v.txt");
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_EQ(names_in(around.folder), std::vector<std::string>{});
}

TEST_F(CliVectors, ASceneThatDivergesIsExitOne) {
  const Finished f = hopmesh("vectors two-nodes --step 30 --set force.gravity=[0,0,-1e6] --out v.txt");
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_THAT(f.out, HasSubstr("diverged in step"));
  EXPECT_EQ(names_in(around.folder), std::vector<std::string>{});
}

} // namespace
} // namespace hopmesh::tests
