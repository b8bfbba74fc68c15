// --checkpoint-every and --resume: a run that was interrupted or killed goes on to the bits of an unbroken
// one, and what is no checkpoint of it is refused with the folder left as it was.
#include "tests/cli/levels_by_name.h"
#include "tests/cli/motions/resume_test.h"

#include "place.h"

#include <csignal>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

// Seven nodes in a row: quick, and no sheet to be pictured.
const std::string row = "two-nodes --set mesh.grid.columns=7 --set force.wind=[0.3,0.1,0]";

class CliResumeLevel : public CliResume, public ::testing::WithParamInterface<std::string> {
 protected:
  void SetUp() override {
    if (!levels::level_named(GetParam(), "").make_ready) return;
    if (run_shell("command -v verilator > /dev/null").exit_code != 0) GTEST_SKIP() << "no verilator here";
    around.environment.emplace_back("HOPMESH_CACHE", HOPMESH_RTL_CACHE);
    around.patience_seconds = 280;
    ASSERT_EQ(hopmesh("run two-nodes --steps 1 --out made" + level()).exit_code, 0);
  }

  std::string level() const { return " --level " + GetParam() + array_for(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Of, CliResumeLevel, ::testing::ValuesIn(levels::level_names()), name_of_level);

TEST_P(CliResumeLevel, AKilledRunGoesOnToTheSameBits) {
  const fs::path unbroken = results_of(row + " --steps 60" + level(), "u");
  const Finished killed =
      ended("run " + row + " --steps 60000 --out r --checkpoint-every 4" + level(), 8, SIGKILL);
  EXPECT_EQ(killed.signal, SIGKILL);
  const Finished f = hopmesh("run --resume r --steps 60");
  EXPECT_EQ(f.exit_code, 0) << f.err;
  EXPECT_EQ(difference(unbroken, at("r")), "");
}

TEST_P(CliResumeLevel, AnInterruptedRunGoesOnToTheSameBits) {
  const fs::path unbroken = results_of(row + " --steps 70 --check" + level(), "u");
  const std::string line = "run " + row + " --steps 60000 --check --out r --checkpoint-every 9" + level();
  const Finished stopped = ended(line, 9, SIGINT);
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_THAT(stopped.out, HasSubstr("To go on\n  hopmesh run --resume r\n"));
  EXPECT_EQ(fault_of_results(at("r"), read_json(at("r/stats.json"))["steps"],
                             levels::level_named(GetParam(), "").has_codes()),
            "");
  EXPECT_EQ(hopmesh("run --resume r --steps 70").exit_code, 0);
  EXPECT_EQ(difference(unbroken, at("r")), "");
}

TEST_F(CliResume, SeveralEndsOfEveryKindMakeNoDifference) {
  const fs::path unbroken = results_of(row + " --steps 900 --level engine", "u");
  ended("run " + row + " --steps 900 --level engine --out r --checkpoint-every 10", 30, SIGTERM);
  for (int k = 2; k < 6; ++k) {
    const std::uint64_t safe = 100u * static_cast<unsigned>(k);
    const Finished f = ended("run --resume r", safe, k % 2 ? SIGINT : SIGKILL); // --checkpoint-every lives on
    EXPECT_THAT(f.err, HasSubstr("checkpoint: goes on behind "));
  }
  EXPECT_EQ(hopmesh("run --resume r -j 2 --checkpoint-every 1000").exit_code, 0);
  EXPECT_EQ(difference(unbroken, at("r")), "");
}

// BDF2 looks two steps back, and a step's scale comes from the step before.
TEST_F(CliResume, AnImplicitMotionGoesOnToTheSameBitsToo) {
  for (const std::string level : {"engine", "reference"}) {
    const std::string scene =
        row + " --set motion.formulation=incremental --set incremental.rule=bdf2 --level " + level;
    const fs::path unbroken = results_of(scene + " --steps 70", "u-" + level);
    ended("run " + scene + " --steps 60000 --out r-" + level + " --checkpoint-every 9", 9, SIGINT);
    const Finished f = hopmesh("run --resume r-" + level + " --steps 70");
    if (f.err.find("--steps: found 70") != std::string::npos) GTEST_SKIP() << "a machine too fast for this";
    EXPECT_EQ(f.exit_code, 0) << f.err;
    EXPECT_EQ(difference(unbroken, at("r-" + level)), "");
  }
}

// The array has weights of a step before, which a resumed run puts back.
TEST_F(CliResume, WeightsThatStayAreThereAgain) {
  const std::string scene = row +
                            " --level engine --no-check --set motion.formulation=incremental"
                            " --set array.output=momentum --set array.schedule=synchronous"
                            " --set relax.refinements=1 --set relax.reload=bias --set relax.reload_every=4";
  const fs::path unbroken = results_of(scene + " --steps 70", "u");
  ended("run " + scene + " --steps 60000 --out r --checkpoint-every 9", 9, SIGINT);
  const Finished f = hopmesh("run --resume r --steps 70");
  if (f.err.find("--steps: found 70") != std::string::npos) GTEST_SKIP() << "a machine too fast for this";
  EXPECT_EQ(f.exit_code, 0) << f.err;
  EXPECT_EQ(difference(unbroken, at("r")), "");
}

TEST_F(CliResume, CtrlCWithoutCheckpointsLeavesOneToo) {
  around.terminal = true;
  Program program(words_of("run flag-400 --level systemc --no-check --out r"), around);
  ASSERT_TRUE(program.wait_for("step 1 of"));
  program.send(SIGINT);
  const Finished f = program.finish();
  EXPECT_EQ(f.exit_code, 130);
  EXPECT_THAT(f.err, ::testing::Not(HasSubstr("safe"))); // nobody asked for it
  around.terminal = false;
  const std::uint64_t done = read_json(at("r/stats.json"))["steps"];
  const std::string steps = std::to_string(done + 2);
  EXPECT_EQ(hopmesh("run --resume r --steps " + steps).exit_code, 0);
  const fs::path unbroken = results_of("flag-400 --level systemc --no-check --steps " + steps, "u");
  EXPECT_EQ(difference(unbroken, at("r")), "");
}

TEST_F(CliResume, TheBarAndTheLinesOfCheckpointsShareATerminal) {
  around.terminal = true;
  const Finished f = hopmesh("run " + row + " --steps 4 --checkpoint-every 2 --out r");
  EXPECT_EQ(f.exit_code, 0);
  EXPECT_THAT(f.err, HasSubstr("\r\033[Kcheckpoint: 2 of 4 steps are safe\r\n"));
  EXPECT_THAT(f.err, HasSubstr("step 4 of 4"));
}

TEST_F(CliResume, CheckpointsChangeNothingAndGoWhenTheRunIsDone) {
  const fs::path plain = results_of(row + " --steps 20", "p");
  const Finished f = hopmesh("run " + row + " --steps 20 --out r --checkpoint-every 7");
  EXPECT_EQ(f.exit_code, 0);
  EXPECT_EQ(f.err, "checkpoint: 0 of 20 steps are safe\ncheckpoint: 7 of 20 steps are safe\n"
                   "checkpoint: 14 of 20 steps are safe\n");
  EXPECT_EQ(difference(plain, at("r")), "");
}

class CliResumeRefusal : public CliResume {
 protected:
  void SetUp() override { ended("run " + row + " --steps 60000 --out r --checkpoint-every 2", 6, SIGKILL); }

  /// A line, exit 2, and not a byte of the folder changed.
  void expect_refused(const std::string& line, const std::string& says) const {
    const auto before = folder_content();
    refused(line, says);
    EXPECT_TRUE(folder_content() == before) << line;
  }
  std::map<std::string, std::string> folder_content() const {
    std::map<std::string, std::string> all;
    for (const std::string& name : names_in(at("r"))) all[name] = content_of(at("r") / name);
    return all;
  }
};

TEST_F(CliResumeRefusal, WhatContradictsTheCheckpoint) {
  expect_refused("run two-nodes --resume r", "SCENE: found --resume beside it");
  for (const char* flag : {"--array byte", "--set motion.steps=3", "--level systemc", "--out q", "--check",
                           "--no-check", "--wave w.vcd"})
    expect_refused(std::string("run --resume r ") + flag, "found --resume beside it");
  expect_refused("run --resume r --steps 2", "--steps: found 2, expected more than the ");
  expect_refused("run --resume r --checkpoint-every 0",
                 "--checkpoint-every: found 0, expected an integer from 1");
  expect_refused("run", "SCENE: found nothing");
}

TEST_F(CliResumeRefusal, WhatIsDamaged) {
  const std::string good = content_of(at("r/checkpoint"));
  std::string bad = good;
  const std::size_t gravity = good.find("gravity");
  bad[gravity + 12] ^= 4;
  write_text(at("r/checkpoint"), bad);
  const auto line = 1 + std::count(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(gravity), '\n');
  expect_refused("run --resume r", "r/checkpoint:" + std::to_string(line) + ": found a damaged line");
  write_text(at("r/checkpoint"), good.substr(0, good.size() - 1));
  expect_refused("run --resume r", "bytes behind this line");
  write_text(at("r/checkpoint"), "[mesh]\n");
  expect_refused("run --resume r", "r/checkpoint:1: found \"[mesh]\", expected a checkpoint of hopmesh");
  write_text(at("r/checkpoint"), good);
  fs::resize_file(at("r/outputs_raw.npy.part"), 200);
  expect_refused("run --resume r", ": outputs_raw.npy: found outputs_raw.npy.part of 200 bytes");
  fs::remove(at("r/outputs_raw.npy.part"));
  expect_refused("run --resume r", "found neither outputs_raw.npy.part nor outputs_raw.npy");
}

TEST_F(CliResumeRefusal, WhatIsForeign) {
  ended("run two-nodes --steps 60000 --out q --checkpoint-every 50", 50, SIGKILL);
  fs::copy(at("q/checkpoint"), at("r/checkpoint"), fs::copy_options::overwrite_existing);
  expect_refused("run --resume r", ": positions.npy: found positions.npy.part ");
  fs::remove(at("r/checkpoint"));
  expect_refused("run --resume r", "r/checkpoint: found no such file, expected the results folder of a run");
  EXPECT_EQ(hopmesh("run --resume nowhere").exit_code, 2);
  EXPECT_FALSE(fs::exists(at("nowhere")));
}

TEST_F(CliResumeRefusal, WhatHasFinishedOrDiverged) {
  EXPECT_EQ(hopmesh("run --resume r --steps 200").exit_code, 0);
  expect_refused("run --resume r", "r/checkpoint: found no such file: the run here has finished");
  const Finished f =
      hopmesh("run two-nodes --set force.gravity=[0,0,-1e15] --set motion.time_step=1e15 --out r "
              "--checkpoint-every 1");
  EXPECT_EQ(f.exit_code, 1);
  expect_refused("run --resume r", "r/checkpoint: found no such file: the run here has diverged");
}

TEST_F(CliResumeRefusal, WhatAnotherRunIsWriting) {
  Program live(words_of("run --resume r"), around);
  ASSERT_TRUE(live.wait_for("goes on"));
  const Finished f = hopmesh("run --resume r"); // the folder does change meanwhile
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_THAT(f.err, HasSubstr("r: another run is writing into this folder"));
}

TEST_F(CliResume, AMeshFileThatChangedIsRefused) {
  fs::copy(HOPMESH_SOURCE_DIR "/tests/scene/good/tent.obj", at("tent.obj"));
  write_text(at("tent.toml"), "[mesh]\nfile = \"tent.obj\"\npinned = [0]\n[motion]\nsteps = 60000\n");
  ended("run tent.toml --out r --checkpoint-every 2", 4, SIGKILL);
  const std::string mesh = content_of(at("tent.obj"));
  const std::size_t x = mesh.find("v ");
  write_text(at("tent.obj"), mesh.substr(0, x) + "v 0.125" + mesh.substr(mesh.find(' ', x + 2)));
  const Finished f = hopmesh("run --resume r");
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_THAT(f.err, ::testing::ContainsRegex("r/checkpoint:[0-9]+: mesh: found .*tent.obj has changed"));
  fs::remove(at("tent.obj"));
  EXPECT_THAT(hopmesh("run --resume r").err, HasSubstr("r/checkpoint:12: mesh.file: found no file "));
  write_text(at("tent.obj"), mesh);
  EXPECT_EQ(hopmesh("run --resume r --steps 30").exit_code, 0);
  EXPECT_EQ(difference(results_of("tent.toml --steps 30", "u"), at("r")), "");
}

TEST_F(CliResume, APictureThatChangedIsRefused) {
  const std::string scenes = HOPMESH_SOURCE_DIR "/sim/scenes/", pgm = content_of(scenes + "snake.pgm");
  write_text(at("disc.pgm"), pgm);
  const std::string snake = "snake --set force.image.file=" + at("disc.pgm").string();
  ended("run " + snake + " --steps 60000 --out r --checkpoint-every 2", 4, SIGKILL);
  std::string other = pgm;
  other.back() = static_cast<char>(other.back() ^ 1); // one pixel by one shade
  write_text(at("disc.pgm"), other);
  const std::string err = refused("run --resume r");
  EXPECT_THAT(err, ::testing::ContainsRegex("r/checkpoint:[0-9]+: image: found .*disc.pgm has changed"));
  write_text(at("disc.pgm"), pgm);
  EXPECT_EQ(hopmesh("run --resume r --steps 200").exit_code, 0);
  EXPECT_EQ(difference(results_of(snake + " --steps 200", "u"), at("r")), "");
}

TEST_F(CliResume, AFullDiskLosesNoSafeStep) {
  around.largest_file = 60'000; // the positions come to it first, after 350 steps
  const Finished f = hopmesh("run " + row + " --steps 60000 --out r --checkpoint-every 20");
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_THAT(f.err, HasSubstr("positions.npy: "));
  const std::uint64_t safe = told_safe(f.err);
  EXPECT_GT(safe, 100u);
  around.largest_file = 0;
  const Finished again = hopmesh("run --resume r --steps 500 --checkpoint-every 1000");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("goes on behind " + std::to_string(safe) + " of 500"));
  EXPECT_EQ(difference(results_of(row + " --steps 500", "u"), at("r")), "");
}

TEST_F(CliResume, ANewRunInTheFolderStartsFromTheBeginning) {
  ended("run " + row + " --steps 60000 --out r --checkpoint-every 2", 6, SIGKILL);
  EXPECT_EQ(difference(results_of(row + " --steps 5", "r"), results_of(row + " --steps 5", "u")), "");
}

} // namespace
} // namespace hopmesh::tests
