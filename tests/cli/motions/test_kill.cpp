// kill -9 at random moments, again and again: no step that was told safe is lost, and in the end every file
// is that of an unbroken run. 40 kills here; HOPMESH_KILLS=300 in the environment makes the long campaign of
// it, HOPMESH_SEED=N repeats one.
#include "sim/run/resume.h"
#include "tests/cli/motions/resume_test.h"

#include <csignal>
#include <random>
#include <thread>

namespace hopmesh::tests {
namespace {

namespace fs = std::filesystem;

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text ? std::stoull(text) : otherwise;
}

class CliKill : public CliResume {
 protected:
  const std::uint64_t seed = from_environment("HOPMESH_SEED", std::random_device()());
  const std::uint64_t kills_wanted = from_environment("HOPMESH_KILLS", 40);
  std::mt19937_64 random{seed};
  std::uint64_t kills = 0, stops = 0, lives = 0, steps_told = 0, nothing_yet = 0;

  std::uint64_t below(std::uint64_t n) { return random() % n; }

  /// Runs the line for a random while, then kills it; now and then it is asked to stop first, and killed
  /// while it does. Short whiles are common: they hit the beginning, where files are taken up.
  Finished broken_off(const std::string& line, double usual_seconds) {
    const double share = static_cast<double>(below(1000)) / 1000;
    const auto wait = [](double seconds) {
      std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    };
    Program program(words_of(line), around);
    wait((below(2) == 0 ? share : share * share) * usual_seconds);
    if (below(5) == 0) {
      program.send(SIGINT);
      wait(static_cast<double>(below(30)) / 1000);
    }
    program.send(SIGKILL);
    return program.finish();
  }

  /// A run from its first step to its last, broken off as often as it takes.
  void live(const std::string& scene, const fs::path& unbroken, double usual_seconds) {
    ++lives;
    const std::string fresh = "run " + scene + " --out r --checkpoint-every " + std::to_string(1 + below(9));
    std::uint64_t safe = 0;
    fs::remove_all(at("r"));
    const auto line = [&] { return fs::exists(at("r/checkpoint")) ? "run --resume r" : fresh; };
    while (kills < kills_wanted && !done() && !HasFailure()) {
      const Finished f = broken_off(line(), usual_seconds);
      EXPECT_TRUE(f.signal == SIGKILL || f.signal == SIGINT || f.exit_code == 130 || f.exit_code == 0)
          << f.err;
      kills += f.signal == SIGKILL, stops += f.signal == SIGINT || f.exit_code == 130;
      steps_told += told_safe(f.err) > safe;
      safe = std::max(safe, told_safe(f.err));
      if (!done()) expect_safe(safe);
    }
    if (!done()) {
      EXPECT_EQ(hopmesh(line()).exit_code, 0);
    }
    EXPECT_EQ(difference(unbroken, at("r")), "") << "seed " << seed << ", life " << lives << ": " << fresh;
  }

  /// A kill may come when all is written.
  bool done() const { return fs::exists(at("r/report.html")) && !fs::exists(at("r/checkpoint")); }

  /// The folder as a kill left it: what was told is in it.
  void expect_safe(std::uint64_t told) {
    if (!fs::exists(at("r/checkpoint"))) {
      ++nothing_yet;
      ASSERT_EQ(told, 0u) << "seed " << seed;
      return;
    }
    const auto found = run::read_run(at("r")); // throws where anything does not fit
    ASSERT_GE(found.saved.state.step, told) << "seed " << seed;
    ASSERT_EQ(found.rows.size(), found.saved.state.step);
  }
};

TEST_F(CliKill, AtRandomMomentsLosesNoSafeStepAndCorruptsNothing) {
  std::printf("seed %lu\n", seed);
  const std::vector<std::string> levels{"engine", "reference", "systemc"};
  std::map<std::string, double> seconds;
  for (const std::string& level : levels) {
    const std::string scene = "two-nodes --set mesh.grid.columns=5 --steps 60 --level " + level;
    results_of(scene, "u-" + level);
    const Finished timed = hopmesh("run " + scene + " --out t --checkpoint-every 5");
    ASSERT_EQ(timed.exit_code, 0);
    seconds[level] = timed.seconds;
  }
  for (std::size_t k = below(3); kills < kills_wanted && !HasFailure(); ++k) {
    const std::string& level = levels[k % levels.size()];
    live("two-nodes --set mesh.grid.columns=5 --steps 60 --level " + level, at("u-" + level), seconds[level]);
  }
  std::printf(
      "%lu kills and %lu stops in %lu runs; %lu of them told new safe steps, %lu came before a checkpoint\n",
      kills, stops, lives, steps_told, nothing_yet);
  EXPECT_GT(steps_told, 0u) << "no kill came while steps were made safe: is the test blind?";
}

} // namespace
} // namespace hopmesh::tests
