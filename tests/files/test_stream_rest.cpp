// A file that grew while its writer was killed or stopped: what of it may be written on, and what not.
#include "sim/files/folder_lock.h"
#include "sim/files/npy.h"
#include "tests/support/files.h"

#include <csignal>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hopmesh::tests {
namespace {

using namespace files;

using testing::HasSubstr;
namespace fs = std::filesystem;

class StreamRestTest : public testing::Test {
 protected:
  /// A stream "head, body", safe up to there, then `more` that nobody marked.
  StreamMark left(const std::string& more) {
    OutputFile file(path);
    file.write("head, ");
    file.write("body");
    const StreamMark mark = file.sync();
    file.write(more);
    file.patch(0, "HEAD");
    return mark;
  }
  std::optional<StreamRest> find(const StreamMark& mark) { return find_rest(path, mark, "head, ", found); }

  const Folder folder;
  const fs::path path = folder / "a.txt", part = folder / "a.txt.part";
  std::string found;
};

TEST_F(StreamRestTest, WhatWasMadeSafeStaysWithoutCommit) {
  const StreamMark mark = left("more");
  EXPECT_EQ(mark.bytes, 10u);
  EXPECT_EQ(content_of(part).substr(0, 10), "HEAD, body");
  EXPECT_FALSE(fs::exists(path));
}

TEST_F(StreamRestTest, IsTakenUpWhereItWasMarked) {
  auto rest = find(left("more"));
  ASSERT_TRUE(rest) << found;
  OutputFile file(path, std::move(*rest));
  EXPECT_EQ(content_of(part), "head, body");
  file.write(" goes on");
  EXPECT_EQ(file.bytes(), 18u);
  file.commit();
  EXPECT_EQ(content_of(path), "head, body goes on");
  EXPECT_FALSE(fs::exists(part));
}

TEST_F(StreamRestTest, MarksGoOnAsIfNothingHadHappened) {
  auto rest = find(left("more"));
  OutputFile file(path, std::move(*rest));
  file.write(std::string(3u << 20, 'x'));
  OutputFile unbroken(folder / "b.txt");
  unbroken.write("head, body" + std::string(3u << 20, 'x'));
  EXPECT_EQ(file.sync().check, unbroken.sync().check);
}

TEST_F(StreamRestTest, IsTakenUpFromItsFinalNameToo) {
  const StreamMark mark = left("more");
  fs::rename(part, path);
  auto rest = find(mark);
  ASSERT_TRUE(rest) << found;
  EXPECT_EQ(rest->found, path);
  OutputFile(path, std::move(*rest)).write("lost, never safe");
  EXPECT_FALSE(fs::exists(path));
  EXPECT_EQ(content_of(part), "head, body");
}

TEST_F(StreamRestTest, ThePartGoesBeforeTheFile) {
  const StreamMark mark = left("");
  fs::copy(part, path);
  EXPECT_EQ(find(mark)->found, part);
  write_text(part, "what another run left"); // and is passed over if it is not the marked one
  EXPECT_EQ(find(mark)->found, path);
}

TEST_F(StreamRestTest, WhatDoesNotFitIsToldAndLeftAlone) {
  const StreamMark mark = left("");
  write_text(part, "HEAD, bod");
  EXPECT_FALSE(find(mark));
  EXPECT_EQ(found, "a.txt.part of 9 bytes");
  write_text(part, "HEAD, bodi");
  EXPECT_FALSE(find(mark));
  EXPECT_THAT(found, HasSubstr("a.txt.part with check "));
  EXPECT_EQ(content_of(part), "HEAD, bodi");
  fs::remove(part);
  EXPECT_FALSE(find(mark));
  EXPECT_EQ(found, "neither a.txt.part nor a.txt");
  fs::create_directory(part);
  EXPECT_FALSE(find(mark));
}

TEST_F(StreamRestTest, ALiveWriterKeepsItsPart) {
  const StreamMark mark = left("");
  auto mine = find(mark), other = find(mark);
  const OutputFile file(path, std::move(*mine));
  EXPECT_THROW(OutputFile(path, std::move(*other)), WriteError);
}

TEST_F(StreamRestTest, ArraysGoOnBehindTheirRows) {
  const std::vector<std::size_t> shape{2};
  StreamMark mark;
  {
    NpyWriter<double> array(path, shape);
    array.append({1, 2});
    array.append({3, 4});
    mark = array.sync();
    array.append({5, 6});
    array.commit(); // as an interrupted run does: the count of rows is in the header now
  }
  auto rest = find_rest(path, mark, NpyWriter<double>::head(shape), found);
  ASSERT_TRUE(rest) << found;
  NpyWriter<double> array(path, shape, std::move(*rest));
  EXPECT_EQ(array.rows(), 2u);
  array.append({7, 8});
  array.commit();
  EXPECT_EQ(read_npy<double>(path).values, (std::vector<double>{1, 2, 3, 4, 7, 8}));
}

TEST(FolderLock, IsHeldByOneAndLeavesNothing) {
  const Folder folder;
  {
    FolderLock first(folder.path());
    const FolderLock moved(std::move(first));
    EXPECT_THROW(FolderLock(folder.path()), WriteError);
  }
  FolderLock again(folder.path());
  EXPECT_TRUE(folder.empty());
}

TEST(FolderLock, EndsWithItsProcess) {
  const Folder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    const FolderLock lock(folder.path());
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_NO_THROW(FolderLock(folder.path()));
}

} // namespace
} // namespace hopmesh::tests
