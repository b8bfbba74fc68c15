// A team has as many members as the system has threads for, and each part of the work is done once.
#include "sim/engine/team.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hopmesh::tests {
namespace {

/// Parts done by a team of so many at most; -1 where one was done twice or not at all.
int parts_done(std::size_t members) {
  engine::Team team(members);
  std::vector<std::atomic<int>> done(team.size());
  for (int round = 0; round < 10; ++round) team.run([&](std::size_t member) { done[member] += 1; });
  for (const auto& times : done)
    if (times != 10) return -1;
  return static_cast<int>(team.size());
}

TEST(Team, HasTheMembersAskedFor) {
  for (const std::size_t members : {1, 2, 5}) EXPECT_EQ(parts_done(members), static_cast<int>(members));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // their shadows need address space
TEST(Team, GoesOnWithTheThreadsThatThereAre) {
  const pid_t child = fork();
  if (child == 0) {
    const rlimit space{std::size_t{600} << 20, std::size_t{600} << 20}; // 8 MB or more for each stack
    setrlimit(RLIMIT_AS, &space);
    const int parts = parts_done(200);
    _exit(parts < 0 ? 255 : parts == 200 ? 254 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
}
#endif

} // namespace
} // namespace hopmesh::tests
