// Whatever goes wrong, under the final name stands a whole file or none.
#include "sim/files/output_file.h"
#include "tests/support/complaint.h"
#include "tests/support/files.h"

#include <csignal>
#include <functional>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hopmesh::tests {
namespace {

using namespace files;

using testing::HasSubstr;

/// The message of the WriteError that the work ends in; it must be one line.
std::string error_of(const std::function<void()>& work) {
  const std::string error = complaint<WriteError>(work);
  EXPECT_EQ(error.find('\n'), std::string::npos);
  return error;
}

/// Runs the work in a process of its own, whose limits and rights it may change; its exit status.
int in_child(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work());
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

TEST(OutputFile, HasItsNameOnlyAfterCommit) {
  const Folder folder;
  OutputFile file(folder / "a.txt");
  file.write("one ");
  file.write("two");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
  EXPECT_TRUE(std::filesystem::exists(folder / "a.txt.part"));
  file.commit();
  EXPECT_EQ(content_of(folder / "a.txt"), "one two");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt.part"));
}

TEST(OutputFile, ExceptionLeavesNothing) {
  const Folder folder;
  try {
    OutputFile file(folder / "a.txt");
    file.write("half");
    throw std::runtime_error("the motion diverged");
  } catch (const std::runtime_error&) {
  }
  EXPECT_TRUE(folder.empty());
}

TEST(OutputFile, ExceptionKeepsTheOlderFile) {
  const Folder folder;
  write_file(folder / "a.txt", "older");
  { OutputFile(folder / "a.txt").write("newer, not committed"); }
  EXPECT_EQ(content_of(folder / "a.txt"), "older");
}

TEST(OutputFile, KilledRunLeavesNoFinalFileAndTheNextTakesOver) {
  const Folder folder;
  const int status = in_child([&] {
    OutputFile file(folder / "a.txt");
    file.write(std::string(3u << 20, 'x'));
    ::raise(SIGKILL);
    return 0;
  });
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
  write_file(folder / "a.txt", "second run");
  EXPECT_EQ(content_of(folder / "a.txt"), "second run");
}

TEST(OutputFile, TwoWritersOfOneFileAreRefused) {
  const Folder folder;
  OutputFile first(folder / "a.txt");
  EXPECT_THAT(error_of([&] { OutputFile second(folder / "a.txt"); }),
              HasSubstr("another run is writing this file"));
  first.write("first");
  first.commit();
  EXPECT_EQ(content_of(folder / "a.txt"), "first");
}

TEST(OutputFile, PatchReplacesBytesAndWritingGoesOnAtTheEnd) {
  const Folder folder;
  OutputFile file(folder / "a.txt");
  file.write("count=?? values");
  file.patch(6, "17");
  file.write(" end");
  file.commit();
  EXPECT_EQ(content_of(folder / "a.txt"), "count=17 values end");
}

TEST(OutputFile, LargeWritesKeepTheirOrder) {
  const Folder folder;
  std::string expected;
  OutputFile file(folder / "a.bin");
  for (const std::size_t size : {1u, 700'000u, 700'000u, 3'000'000u, 5u}) {
    const std::string piece(size, static_cast<char>('a' + expected.size() % 26));
    file.write(piece);
    expected += piece;
  }
  file.commit();
  EXPECT_EQ(content_of(folder / "a.bin"), expected);
}

TEST(OutputFile, MissingFolderIsNamed) {
  const Folder folder;
  const auto path = folder / "missing/a.txt";
  EXPECT_EQ(error_of([&] { write_file(path, "x"); }),
            path.string() + ": cannot create: No such file or directory");
}

TEST(OutputFile, FolderInPlaceOfAFileIsRefused) {
  const Folder folder;
  EXPECT_THAT(error_of([&] { write_file(folder.path(), "x"); }), HasSubstr("Is a directory"));
}

TEST(OutputFile, FullDiskIsToldAtOnce) {
  EXPECT_THAT(error_of([] { write_file("/dev/full", "x"); }),
              HasSubstr("/dev/full: cannot write: No space left"));
}

TEST(OutputFile, DiskThatFillsUpLeavesNothing) {
  const Folder folder;
  const int status = in_child([&] {
    const rlimit limit{1u << 20, 1u << 20};
    ::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto message = error_of([&] { write_file(folder / "a.bin", std::string(4u << 20, 'x')); });
    return message.find("cannot write: File too large") == std::string::npos ? 1 : 0;
  });
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(folder.empty());
}

TEST(OutputFile, ForbiddenFolderIsToldBeforeWorkStarts) {
  const Folder folder;
  std::filesystem::permissions(folder.path(),
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec |
                                   std::filesystem::perms::others_read | std::filesystem::perms::others_exec);
  const int status = in_child([&] {
    if (::geteuid() == 0 && ::seteuid(65534) != 0) return 2; // root may write anywhere
    const auto early = error_of([&] { check_writable(folder.path(), 0); });
    const auto late = error_of([&] { write_file(folder / "a.txt", "x"); });
    return early.find("Permission denied") != std::string::npos &&
                   late.find("Permission denied") != std::string::npos
               ? 0
               : 1;
  });
  EXPECT_EQ(status, 0);
}

TEST(CheckWritable, MakesTheFolderAndLeavesItEmpty) {
  const Folder folder;
  check_writable(folder / "deep/er", 1000);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "deep/er"));
}

TEST(CheckWritable, ClearsAwayWhatAKilledProbeLeft) {
  const Folder folder;
  write_file(folder / ".writable", "");
  check_writable(folder.path(), 0);
  EXPECT_TRUE(folder.empty());
}

TEST(CheckWritable, TellsHowMuchSpaceIsMissing) {
  const Folder folder;
  const auto message = error_of([&] { check_writable(folder.path(), std::uint64_t{1} << 62); });
  EXPECT_THAT(message, HasSubstr("4611686.0 TB are needed"));
  EXPECT_THAT(message, HasSubstr("No space left on device"));
}

TEST(CheckWritable, FileInTheWayIsNamed) {
  const Folder folder;
  write_file(folder / "out", "a file");
  EXPECT_THAT(error_of([&] { check_writable(folder / "out", 1); }), HasSubstr((folder / "out").string()));
}

TEST(OutputFile, FollowsNoLinkInThePlaceOfItsPart) {
  const Folder folder;
  folder.write("victim", "precious");
  std::filesystem::create_symlink("victim", folder / "a.txt.part");
  EXPECT_THAT(error_of([&] { OutputFile file(folder / "a.txt"); }), HasSubstr("found a symbolic link"));
  EXPECT_EQ(content_of(folder / "victim"), "precious");
}

TEST(OutputFile, ManyMayWriteTheSameFileOnce) {
  const Folder folder;
  std::vector<pid_t> children;
  for (int k = 0; k < 20; ++k) {
    children.push_back(::fork());
    if (children.back() != 0) continue;
    try {
      write_once(folder / "a.txt", "of all of us");
      ::_exit(content_of(folder / "a.txt") == "of all of us" ? 0 : 1);
    } catch (const std::exception&) {
      ::_exit(2);
    }
  }
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a.txt"});
}

} // namespace
} // namespace hopmesh::tests
