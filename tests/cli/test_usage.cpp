// Every mistake in a command: exit 2, nothing on stdout, one line on stderr that says what was found and what
// was expected, and no file left.
#include "tests/support/cli_test.h"

namespace hopmesh::tests {
namespace {

struct Mistake {
  const char* name;
  const char* line;
  std::vector<const char*> says;
};

class CliMistake : public Cli, public ::testing::WithParamInterface<Mistake> {};

TEST_P(CliMistake, IsRefusedInOneLine) {
  const std::string err = refused(GetParam().line);
  EXPECT_EQ(err.rfind("hopmesh: ", 0), 0u) << err;
  for (const char* words : GetParam().says) EXPECT_THAT(err, ::testing::HasSubstr(words));
  EXPECT_EQ(names_in(around.folder), std::vector<std::string>{});
}

// Named by the mistake; "mean" is followed by the nearest valid name.
const std::vector<Mistake> mistakes{
    {"Verb",
     "rnu flag-400",
     {"verb: found rnu", "run, compare, info, vectors, fuzz, rtl, cost, sweep, chart, stability",
      "mean run?"}},
    {"VerbFarFromAll",
     "dance flag-400",
     {"found dance", "run, compare, info, vectors, fuzz, rtl, cost, sweep, chart, stability"}},
    {"Flag", "run two-nodes --lvel systemc", {"flag: found --lvel", "mean --level?"}},
    {"FlagWithValue", "run two-nodes --stps=4", {"found --stps", "mean --steps?"}},
    {"FlagOfAnotherVerb", "info two-nodes --steps 4", {"found --steps", "--toml"}},
    {"FlagBeforeVerb", "--versoin", {"found --versoin", "mean --version?"}},
    {"FlagBeforeScene", "run --no-chekc two-nodes", {"found --no-chekc", "mean --no-check?"}},
    {"NoScene", "run", {"SCENE: found nothing, expected a scene file"}},
    {"Scene",
     "run two-nodse",
     {"scene: found \"two-nodse\"", "flag-225, flag-225-letter, flag-400", "mean two-nodes?"}},
    {"EmptyScene", "run ''", {"scene: found \"\"", "a scene file, or one of"}},
    {"SceneFile", "info nowhere.toml", {"nowhere.toml: found no such file", "a scene file"}},
    {"TwoScenes", "run two-nodes flag-400", {"run: found \"flag-400\" as well, expected no more words"}},
    {"Level", "run two-nodes --level refrence", {"--level: found refrence", "mean reference?"}},
    {"LevelTwice", "run two-nodes --level systemc --level reference", {"--level"}},
    {"Array", "run two-nodes --array dscent", {"found \"dscent\"", "\"prescaled\"", "mean descent?"}},
    {"ArrayFile", "info two-nodes --array none.toml", {"none.toml: found no such file", "an array file"}},
    {"OutEmpty", "run two-nodes --out ''", {"--out: found an empty value, expected results folder"}},
    {"ResumeEmpty", "run --resume ''", {"--resume: found an empty value"}},
    {"ReplayEmpty", "fuzz --replay ''", {"--replay: found an empty value"}},
    {"SolveOutEmpty", "solve w.mtx --out ''", {"--out: found an empty value"}},
    {"NetworkOutEmpty", "network two-nodes --step 1 --out ''", {"--out: found an empty value"}},
    {"SecondsNan", "fuzz --seconds nan", {"--seconds: found nan"}},
    {"TimeNan", "budget two-nodes --time nan", {"--time: found nan"}},
    {"ErrorNan", "size two-nodes --error nan", {"--error: found nan"}},
    {"SharePlus", "sweep first-widths --share +0/2", {"--share: found +0/2"}},
    {"ShareBlank", "sweep first-widths --share ' 0/2'", {"--share: found  0/2"}},
    {"ShareOfAll", "sweep first-widths --share 0/18446744073709551616", {"--share: found 0/18"}},
    {"ShareOfTooMany", "sweep first-widths --share 0/18446744073709551615", {"--share: found 0/18"}},
    {"FlagWithoutValue", "run two-nodes --out", {"--out: found no value, expected results folder"}},
    {"SetWithoutValue", "run two-nodes --set", {"--set: found no value, expected key.path=value"}},
    {"SetWithoutEquals", "run two-nodes --set probe.gamma", {"found \"probe.gamma\"", "key.path=value"}},
    {"SetUnknownTable", "run two-nodes --set prboe.gamma=1", {"prboe", "unknown key"}},
    {"SetUnknownKey", "run two-nodes --set probe.gmma=1", {"probe.gmma", "mean probe.gamma?"}},
    {"SetUnknownArrayKey", "run two-nodes --set array.lane=1", {"array.lane", "mean array.lanes?"}},
    {"SetUnknownFormat", "run two-nodes --set formats.wieght=1", {"formats.wieght", "mean formats.weight?"}},
    {"SetFarTooLarge", "run two-nodes --set probe.gamma=1e999", {"probe.gamma: found", "0 to 1e15"}},
    {"SetNotANumber", "run two-nodes --set motion.time_step=nan", {"motion.time_step: found nan"}},
    {"SetWord", "run two-nodes --set mesh.mass=heavy", {"mesh.mass: found \"heavy\"", "a number"}},
    {"SetSchedule", "run two-nodes --set array.schedule=colored", {"array.schedule", "coloured"}},
    {"SetFormat", "run two-nodes --set formats.state=fixed<16,2,SC_RDN>", {"mean SC_RND?"}},
    {"ArrayRule", "run two-nodes --set array.lanes=0", {"array.lanes: found 0", "1 to 64"}},
    {"StepsZero", "run two-nodes --steps 0", {"--steps: found 0, expected an integer from 1"}},
    {"StepsNegative", "compare two-nodes --steps -3", {"--steps: found -3, expected an integer from 1"}},
    {"StepsReal", "run two-nodes --steps 1.5", {"--steps: found 1.5, expected an integer"}},
    {"StepsWord", "run two-nodes --steps ten", {"--steps: found ten, expected an integer"}},
    {"StepsHuge", "run two-nodes --steps 99999999999999999999", {"--steps: found 99999999999999999999"}},
    {"Levels", "compare two-nodes --levels reference,systemd", {"found systemd", "mean systemc?"}},
    {"OneLevel", "compare two-nodes --levels systemc", {"systemc alone", "at least two levels"}},
    {"LevelInPairs", "compare two-nodes --levels systemc,systemc", {"systemc twice"}},
    {"LevelApart", "compare two-nodes --levels systemc,systemc-clock,systemc", {"systemc twice"}},
    {"Study", "sweep first-width", {"study: found \"first-width\"", "mean first-widths?"}},
    {"StudyFile", "stability nowhere.toml", {"nowhere.toml: found no such file", "a study file"}},
    {"Share", "sweep first-widths --share 2/2", {"--share: found 2/2", "K from 0 to N - 1"}},
    {"Executor", "sweep first-widths --executor cloud", {"--executor: found cloud, expected local, slurm"}},
    {"Workers", "sweep first-widths -j 0", {"-j: found 0, expected an integer from 1"}},
    {"ChartOfNothing", "chart nowhere", {"nowhere/results.csv: found no such file"}},
    {"NoStep", "network two-nodes --out n", {"--step: found nothing, expected the step"}},
    {"NoOut", "network two-nodes --step 1", {"--out: found nothing, expected folder for"}},
    {"SolversNoStep", "solvers two-nodes", {"--step: found nothing, expected the step"}},
    {"SolversStepBeyond", "solvers two-nodes --step 40 --out s", {"--step: found 40, expected 0 to 39"}},
    {"SolversGap",
     "solvers two-nodes --step 1 --gap 1e-2,2",
     {"--gap: found 2, expected a number above 0 and below 1"}},
    {"SolversGapWord", "solvers two-nodes --step 1 --gap small", {"--gap: found small, expected a number"}},
    {"SolversGapNan", "solvers two-nodes --step 1 --gap nan", {"--gap: found nan, expected a number"}},
    {"SolversGapTwice",
     "solvers two-nodes --step 1 --gap 1e-2,0.01",
     {"--gap: found 0.01 twice", "each gap once"}},
    {"SolversMaxSweeps",
     "solvers two-nodes --step 1 --max-sweeps 0",
     {"--max-sweeps: found 0, expected an integer from 1"}},
    {"SolversStillProbe",
     "solvers two-nodes --step 1 --still",
     {"--still: found a scene of the probe", "formulation = \"incremental\""}},
    {"SolversStillCold",
     "solvers banner --step 1 --still --cold",
     {"--cold: found --still beside it, expected one of the two"}},
    {"SolversTimeStepAlone",
     "solvers banner --step 1 --time-step 0.1",
     {"--time-step: found no --still, expected --still beside it"}},
    {"SolversTimeStepZero",
     "solvers banner --step 1 --still --time-step 0",
     {"--time-step: found 0, expected a number above 0"}},
    {"SolversFlag", "solvers two-nodes --stpe 1", {"flag: found --stpe", "mean --step?"}},
    {"SolversScene", "solvers two-nodse --step 1", {"mean two-nodes?"}},
    {"StepBeyond", "network two-nodes --step 40 --out n", {"--step: found 40, expected 0 to 39"}},
    {"StepNegative", "network two-nodes --step -1 --out n", {"--step: found -1, expected an integer from 0"}},
    {"WindowAlone", "run two-nodes --wave-window 0:1", {"--wave-window", "no --wave"}},
    {"CellsAlone", "run two-nodes --wave-cells 0", {"--wave-cells", "no --wave"}},
    {"WaveOfTheReference", "run two-nodes --level reference --wave w.vcd", {"--wave: found level reference"}},
    {"WindowBackwards",
     "run two-nodes --level systemc --wave w.vcd --wave-window 5:3",
     {"5:3", "begins before it ends"}},
    {"WindowWord", "run two-nodes --level systemc --wave w.vcd --wave-window now", {"found now", "FROM:TO"}},
    {"CellsWord", "run two-nodes --level systemc --wave w.vcd --wave-cells all", {"found all", "0,4,10-12"}},
    {"CellsBackwards", "run flag-225 --level systemc --wave w.vcd --wave-cells 5-2", {"found 5-2", "rising"}},
    {"CellsWithoutEnd",
     "run two-nodes --level systemc --wave w.vcd --wave-cells 0-999999999",
     {"0-999999999"}},
    {"CellBeyond",
     "run two-nodes --level systemc --wave w.vcd --wave-cells 1",
     {"found 1, expected cells below 1"}},
    {"VectorsOfNothing", "vectors --out v.txt", {"vectors: found nothing to do", "SCENE --step K"}},
    {"VectorsOfTwo", "vectors two-nodes --step 1 --random 3 --out v.txt", {"found several sources"}},
    {"VectorsWithoutStep", "vectors two-nodes --out v.txt", {"--step: found none"}},
    {"VectorsStepOfNoScene", "vectors --random 1 --step 3 --out v.txt", {"--step: found no scene"}},
    {"VectorsArrayOfNoScene", "vectors --random 1 --array byte --out v.txt", {"without a scene"}},
    {"VectorsWithoutOut", "vectors --random 1", {"--out: found none"}},
    {"VectorsCheckAndOut", "vectors --check v.txt --out w.txt", {"--out: found a file beside --check"}},
    {"VectorsBlankCheck", "vectors --check v.txt --blank", {"--blank"}},
    {"VectorsLevel",
     "vectors --random 1 --level sytemc --out v.txt",
     {"--level: found sytemc", "mean systemc?"}},
    {"VectorsReference", "vectors --random 1 --level reference --out v.txt", {"found reference", "engine"}},
    {"VectorsNoCases", "vectors --random 0 --out v.txt", {"--random: found 0, expected an integer from 1"}},
    {"VectorsSeed", "vectors --random 1 --seed -1 --out v.txt", {"--seed: found -1, expected"}},
    {"VectorsSweeps", "vectors two-nodes --step 1 --sweeps 0 --out v.txt", {"--sweeps: found 0"}},
    {"VectorsBadFolder", "vectors --random 1 --out /proc/none/v.txt", {"/proc/none"}},
    {"FuzzLevel", "fuzz --levels engine,sytemc", {"--levels: found sytemc", "mean systemc?"}},
    {"FuzzReference", "fuzz --levels engine,reference", {"--levels: found reference"}},
    {"FuzzOneLevel", "fuzz --levels systemc", {"systemc alone", "at least two levels"}},
    {"FuzzCases", "fuzz --cases 0", {"--cases: found 0, expected an integer from 1"}},
    {"FuzzSeconds", "fuzz --seconds -1", {"--seconds: found -1, expected a number from 0.001 to"}},
    {"Threads", "run two-nodes -j 999", {"-j: found 999, expected an integer from 1 to 256"}},
    {"Against", "size banner --error 1 --against truht", {"--against: found truht", "mean truth?"}},
    {"CheckAndNoCheck", "run two-nodes --check --no-check", {"expected one of the two"}},
    {"HelpOfNoVerb", "help rnu", {"help: found rnu", "mean run?"}},
    {"FuzzSeed", "fuzz --seed many", {"--seed: found many, expected an integer from 0"}},
    {"FuzzFirst", "fuzz --first -3", {"--first: found -3, expected an integer from 0"}},
    {"FuzzChildren", "fuzz -j 0", {"-j"}},
    {"FuzzReplay", "fuzz --replay none.txt", {"none.txt: found no such file", "test vectors"}},
    {"FuzzScene", "fuzz flag-400", {"flag-400"}},
    {"SolveNothing", "solve", {"W: found nothing, expected weights"}},
    {"SolveProblem", "solve box-randm-100", {"W: found \"box-randm-100\"", "mean box-random-100?"}},
    {"SolveLevel", "solve cut-20 --level sytemc", {"--level: found sytemc", "mean systemc?"}},
    {"SolveRule",
     "solve cut-20 --rule binray",
     {"--rule: found binray, expected modified, binary", "mean binary?"}},
    {"SolveArray", "solve cut-20 --array dscent", {"mean descent?"}},
    {"SolveSetOfAScene", "solve cut-20 --set motion.steps=3", {"motion", "unknown key"}},
    {"SolveSweeps", "solve cut-20 --sweeps 0", {"--sweeps: found 0, expected an integer from 1"}},
    {"SolveThreshold",
     "solve cut-20 --threshold -1",
     {"--threshold: found -1, expected a number from 0 to 2"}},
    {"SolveThresholdNan", "solve cut-20 --threshold nan", {"--threshold: found nan"}},
    {"SolveSeed", "solve cut-20 --seed 0", {"--seed: found 0, expected an integer from 1"}},
    {"SolveBadFolder", "solve cut-20 --out /proc/none", {"/proc/none"}},
    {"ProblemName", "problem queens-9 --out q", {"NAME: found \"queens-9\"", "mean queens-8?"}},
    {"ProblemWithoutOut", "problem queens-8", {"--out: found nothing, expected folder for"}},
    {"ProblemWithoutName", "problem --out q", {"NAME: found nothing, expected a problem"}},
    {"ProblemSeed", "problem queens-8 --seed 0 --out q", {"--seed: found 0"}},
    {"WaveIsAFolder", "run two-nodes --level systemc --wave .", {"--wave: found the folder ."}},
};

INSTANTIATE_TEST_SUITE_P(Of, CliMistake, ::testing::ValuesIn(mistakes),
                         [](const auto& made) { return made.param.name; });

TEST_F(Cli, ARuleThatOnlyTheMeshBreaksIsToldBeforeTheRun) {
  const std::string line = " --set formats.weight=fixed<31,1> --set formats.link=fixed<29,2> "
                           "--set formats.state=fixed<29,2> --set formats.bias=fixed<24,1>";
  // 30 + 27 places, and a sign. Rows of 3 sum to 4 at most: 61 bits in all. Rows of 27 sum to 28: 63.
  good("info two-nodes" + line);
  refused("run flag-400 --out o" + line, "for rows of 27 inputs");
  EXPECT_FALSE(std::filesystem::exists(at("o")));
}

TEST_F(Cli, AMistakeInAFileNamesItsLine) {
  write_text(at("s.toml"), "[mesh]\ngrid = { rows = 2, columns = 2 }\npined = \"left\"\n");
  const Finished f = hopmesh("run s.toml");
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_THAT(f.err, ::testing::HasSubstr("s.toml:3: mesh.pined"));
  EXPECT_THAT(f.err, ::testing::HasSubstr("mean mesh.pinned?"));
}

} // namespace
} // namespace hopmesh::tests
