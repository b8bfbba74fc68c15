// Children of a pool: all are run, a crash is told and stops nobody, a stop ends what runs.
#include "sim/run/children.h"

#include "sim/files/output_file.h"
#include "sim/input/input_error.h"
#include "tests/support/complaint.h"
#include "tests/support/files.h"

#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <new>
#include <stdexcept>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>

namespace hopmesh::tests {
namespace {

using namespace run;

TEST(Children, TellsHowEachChildEnded) {
  const std::atomic<bool> stop{false};
  std::map<std::size_t, std::pair<int, int>> ends;
  const auto work = [](std::size_t n) {
    if (n == 3) std::raise(SIGKILL);
    return n == 5 ? 7 : 0;
  };
  EXPECT_TRUE(run_in_children(
      {1, 3, 5, 8}, 2, work,
      [&](std::size_t n, const ChildEnd& end) {
        ends[n] = {end.exit_code, end.signal};
      },
      stop));
  const std::map<std::size_t, std::pair<int, int>> expected{
      {1, {0, 0}}, {3, {0, SIGKILL}}, {5, {7, 0}}, {8, {0, 0}}};
  EXPECT_EQ(ends, expected);
}

TEST(Children, AStopEndsThemBeforeTheirTime) {
  std::atomic<bool> stop{false};
  const auto work = [](std::size_t n) {
    if (n > 0) pause();
    return 0;
  };
  EXPECT_FALSE(run_in_children(
      {0, 1, 2}, 2, work, [&](std::size_t, const ChildEnd&) { stop = true; }, stop));
}

TEST(Children, OneChildAloneTellsHowItEnded) {
  EXPECT_EQ(run_in_child([] { return 7; }, 10).exit_code, 7);
  EXPECT_EQ(run_in_child([]() -> int { throw std::runtime_error("no"); }, 10).exit_code, child_failed);
  EXPECT_EQ(run_in_child([] { return std::raise(SIGKILL); }, 10).signal, SIGKILL);
  const auto hang = [] {
    while (pause() == -1) {
    }
    return 0;
  };
  EXPECT_EQ(run_in_child(hang, 1).signal, SIGALRM);
}

// Were it not killed, its owner would wait for it for ever.
TEST(Children, AChildThatIsGivenUpIsKilled) {
  const Child child([] { return pause(); });
}

/// How the work 0 ends, and how often it was begun.
std::pair<ChildEnd, std::size_t> ended(const Folder& folder, const std::function<int(std::size_t)>& work) {
  const std::atomic<bool> stop{false};
  std::pair<ChildEnd, std::size_t> result;
  const auto counted = [&](std::size_t number) {
    std::ofstream(folder / "begun", std::ios::app) << 'x';
    return work(std::filesystem::file_size(folder / "begun") + number);
  };
  run_in_children(
      {0}, 1, counted, [&](std::size_t, const ChildEnd& end) { result.first = end; }, stop);
  result.second = content_of(folder / "begun").size();
  return result;
}

TEST(Children, OneThatWasEndedFromOutsideIsTriedOnceMore) {
  for (const int signal : {SIGKILL, SIGTERM, SIGHUP}) {
    const Folder folder;
    const auto [end, begun] =
        ended(folder, [&](std::size_t times) { return times == 1 ? raise(signal) : 0; });
    EXPECT_TRUE(end.good());
    EXPECT_EQ(begun, 2u);
  }
  const Folder folder;
  const auto [end, begun] = ended(folder, [](std::size_t) { return std::raise(SIGKILL); });
  EXPECT_TRUE(end.from_outside());
  EXPECT_EQ(begun, 2u);
}

TEST(Children, ACrashOfItsOwnIsNot) {
  const Folder folder;
  const auto [end, begun] = ended(folder, [](std::size_t) {
    std::signal(SIGSEGV, SIG_DFL);
    return std::raise(SIGSEGV);
  });
  EXPECT_FALSE(end.from_outside());
  EXPECT_EQ(begun, 1u);
}

TEST(Children, WhatTheSystemRefusesToOneEndsAll) {
  const std::vector<std::pair<std::function<void()>, std::string>> refusals{
      {[] { throw files::WriteError("a.csv: cannot write: No space left on device"); },
       "a.csv: cannot write"},
      {[] { throw std::bad_alloc(); }, "memory: found less"},
      {[] { throw std::system_error(EAGAIN, std::generic_category(), "thread"); }, "thread: Resource"},
      {[] { throw input::InputError("b.csv:2: damaged"); }, "b.csv:2: damaged"}};
  for (const auto& [refuse, words] : refusals) {
    const Folder folder;
    const auto work = [&, fail = refuse](std::size_t) { return fail(), 0; };
    EXPECT_THAT(complaint<Refused>([&] { ended(folder, work); }), testing::HasSubstr(words));
  }
}

TEST(Children, AnExceptionIsToldWithItsWords) {
  const Folder folder;
  const auto end = ended(folder, [](std::size_t) -> int { throw std::logic_error("a defect"); }).first;
  EXPECT_EQ(describe(end), "ended with exit code 98: a defect");
}

// Rights are given up in a process of its own: root may have as many processes as it likes.
TEST(Children, AreFewerWhereTheSystemHasNoMore) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can become a user without processes";
  const auto all_done = [] {
    const rlimit few{3, 3};
    if (setgid(54321) != 0 || setuid(54321) != 0 || setrlimit(RLIMIT_NPROC, &few) != 0) return 50;
    const std::atomic<bool> stop{false};
    std::size_t done = 0;
    run_in_children(
        {0, 1, 2, 3, 4, 5, 6, 7}, 8, [](std::size_t) { return usleep(20'000); },
        [&](std::size_t, const ChildEnd& end) { done += end.good(); }, stop);
    return static_cast<int>(done);
  };
  EXPECT_EQ(run_in_child(all_done, 60).exit_code, 8);
}

TEST(Children, TheirEndIsToldInWords) {
  EXPECT_EQ(describe({3, 0, ""}), "ended with exit code 3");
  EXPECT_EQ(describe({0, SIGKILL, ""}), "killed by signal 9 (Killed)");
}

} // namespace
} // namespace hopmesh::tests
