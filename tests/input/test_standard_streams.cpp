// Descriptors 0 to 2 that are closed or full, each in a process of its own.
#include "sim/input/standard_streams.h"

#include <cstdio>
#include <fcntl.h>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hopmesh::tests {
namespace {

int exit_of(const std::function<int()>& work) {
  const pid_t child = fork();
  if (child == 0) _exit(work());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void put_in_place(const char* file, int stream) {
  const int opened = open(file, O_RDWR);
  dup2(opened, stream);
  close(opened);
}

TEST(StandardStreams, ClosedOnesAreTaken) {
  EXPECT_EQ(exit_of([] {
              close(0), close(1), close(2);
              input::open_standard_streams();
              return (fcntl(0, F_GETFD) >= 0) + (fcntl(1, F_GETFD) >= 0) + (fcntl(2, F_GETFD) >= 0);
            }),
            3);
}

TEST(StandardStreams, OpenOnesStay) {
  EXPECT_EQ(exit_of([] {
              put_in_place("/dev/full", 1);
              input::open_standard_streams();
              return write(1, "x", 1) < 0 ? 7 : 0;
            }),
            7);
}

TEST(StandardStreams, SayingIntoAFullStderrIsNoFault) {
  EXPECT_EQ(exit_of([] {
              put_in_place("/dev/full", 2);
              input::say("nobody reads this\n");
              return 5;
            }),
            5);
}

TEST(StandardStreams, WhatWasPrintedAndLostIsTold) {
  EXPECT_EQ(exit_of([] {
              put_in_place("/dev/full", 1);
              std::fputs("lost\n", stdout);
              try {
                input::finish_stdout();
              } catch (const std::system_error&) {
                return 9;
              }
              return 0;
            }),
            9);
}

} // namespace
} // namespace hopmesh::tests
