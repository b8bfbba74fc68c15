// hopmesh sweep --executor slurm on a real cluster of one node, started here on loopback by the current user.
#include "tests/support/cli_test.h"

#include "place.h"

#include <csignal>
#include <fstream>
#include <unistd.h>

namespace hopmesh::tests {
namespace {

class CliSlurm : public Cli {
 protected:
  ~CliSlurm() override {
    for (const char* daemon : {"slurmctld", "slurmd", "munged"}) {
      pid_t pid = 0;
      if (std::ifstream(at("slurm") / (std::string(daemon) + ".pid")) >> pid && pid > 1) kill(pid, SIGTERM);
    }
    usleep(500'000); // they write into the folder until they end
  }

  Finished start() const {
    const int port = 20'000 + 2 * (getpid() % 20'000);
    return run_shell("timeout 60 sh " HOPMESH_SOURCE_DIR "/tests/cli/studies/slurm_cluster '" +
                     at("slurm").string() + "' " + std::to_string(port) + " > '" + at("why").string() +
                     "' 2>&1");
  }
};

TEST_F(CliSlurm, RunsTheSamePointsAsAJobArray) {
  if (start().exit_code != 0) GTEST_SKIP() << "no Slurm here: " << content_of(at("why"));
  around.environment.emplace_back("SLURM_CONF", (at("slurm") / "slurm.conf").string());
  write_text(at("s.toml"),
             "scene = \"two-nodes\"\nsteps = 5\n[axes]\n\"motion.time_step\" = [0.01, 0.02, 0.05]\n");
  good("sweep s.toml --out here");
  good("sweep s.toml --out there -j 2 --executor slurm");
  const Table here = read_table(at("here") / "results.csv"), there = read_table(at("there") / "results.csv");
  EXPECT_EQ(here.header, there.header);
  for (const char* column : {"point", "motion.time_step", "position_error", "sweeps", "cycles"})
    EXPECT_EQ(here.numbers(column), there.numbers(column)) << column;
  for (const char* log : {"task-0.log", "task-1.log"})
    EXPECT_TRUE(std::filesystem::exists(at("there") / log));
}

} // namespace
} // namespace hopmesh::tests
