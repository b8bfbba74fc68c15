// NumPy files, against bytes laid down by hand from the format's description.
#include "sim/files/npy.h"
#include "tests/support/complaint.h"
#include "tests/support/files.h"

#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <limits>

namespace hopmesh::tests {
namespace {

using namespace files;

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Npy, BytesAreThoseOfTheFormat) {
  const Folder folder;
  NpyWriter<std::int32_t> file(folder / "a.npy", {1, 2});
  file.append(std::vector<std::int32_t>{1, -2});
  file.commit();
  std::string dictionary = "{'descr': '<i4', 'fortran_order': False, 'shape': (1, 1, 2), }";
  dictionary.resize(117, ' ');
  const std::string expected = std::string("\x93NUMPY\x01\x00\x76\x00", 10) + dictionary + "\n" +
                               std::string("\x01\x00\x00\x00\xfe\xff\xff\xff", 8);
  EXPECT_EQ(expected.size(), 128u + 8u);
  EXPECT_EQ(content_of(folder / "a.npy"), expected);
}

TEST(Npy, DoublesComeBackBitForBit) {
  const Folder folder;
  using limits = std::numeric_limits<double>;
  const std::vector<double> row{0.1,      -0.0, limits::denorm_min(), limits::max(), limits::infinity(),
                                1.0 / 3.0};
  NpyWriter<double> file(folder / "a.npy", {2, 3});
  file.append(row);
  file.commit();
  const auto array = read_npy<double>(folder / "a.npy");
  EXPECT_THAT(array.shape, ElementsAre(1, 2, 3));
  EXPECT_EQ(std::memcmp(array.values.data(), row.data(), row.size() * sizeof(double)), 0);
}

TEST(Npy, RunStoppedEarlyHasTheRowsItGotTo) {
  const Folder folder;
  NpyWriter<double> file(folder / "a.npy", {4, 3});
  for (int step = 0; step < 7; ++step) file.append(std::vector<double>(12, step));
  file.commit(); // the run was interrupted here; 400 steps were planned
  const auto array = read_npy<double>(folder / "a.npy");
  EXPECT_THAT(array.shape, ElementsAre(7, 4, 3));
  EXPECT_EQ(array.values.size(), 7u * 12u);
  EXPECT_EQ(array.values.back(), 6.0);
}

TEST(Npy, WithoutCommitNothingStays) {
  const Folder folder;
  { NpyWriter<double>(folder / "a.npy", {1, 1}).append(std::vector<double>{1}); }
  EXPECT_TRUE(folder.empty());
}

TEST(Npy, SingleRowsAreReadByIndex) {
  const Folder folder;
  NpyWriter<std::int32_t> file(folder / "a.npy", {2, 2});
  for (std::int32_t step = 0; step < 1000; ++step) file.append(std::vector<std::int32_t>{step, -step, 7, 8});
  file.commit();
  NpyReader<std::int32_t> reader(folder / "a.npy");
  EXPECT_EQ(reader.rows(), 1000u);
  EXPECT_THAT(reader.row(999), ElementsAre(999, -999, 7, 8));
  EXPECT_THAT(reader.row(0), ElementsAre(0, 0, 7, 8));
  EXPECT_THROW(reader.row(1000), ReadError);
}

TEST(Npy, RowOfWrongLengthIsRefused) {
  const Folder folder;
  NpyWriter<double> file(folder / "a.npy", {2, 3});
  EXPECT_THROW(file.append(std::vector<double>(5)), WriteError);
}

std::string read_error(const std::filesystem::path& path) {
  return complaint<ReadError>([&] { read_npy<double>(path); });
}

TEST(Npy, OtherFilesAreRefusedByName) {
  const Folder folder;
  write_file(folder / "text.npy", "not an array");
  EXPECT_THAT(read_error(folder / "text.npy"), HasSubstr("not a NumPy 1.0 array file"));
  EXPECT_THAT(read_error(folder / "missing.npy"), HasSubstr("cannot be opened"));
  NpyWriter<std::int32_t> integers(folder / "integers.npy", {1, 1});
  integers.commit();
  EXPECT_THAT(read_error(folder / "integers.npy"), HasSubstr("type '<i4', expected '<f8'"));
}

TEST(Npy, FileCutShortIsRefused) {
  const Folder folder;
  NpyWriter<double> file(folder / "a.npy", {2, 3});
  file.append(std::vector<double>(6));
  file.commit();
  std::filesystem::resize_file(folder / "a.npy", 128 + 6 * 8 - 1);
  EXPECT_THAT(read_error(folder / "a.npy"), HasSubstr("shorter than its header says"));
}

// Sizes are compared with the file before anything is made for them.
TEST(Npy, SizesBeyondTheFileAreRefused) {
  const Folder folder;
  for (const char* shape :
       {"(1, 1000000000000000000)", "(4294967296, 4294967296)", "(2, 0, 9223372036854775808)",
        "(18446744073709551615,)", "(3, 6148914691236517206)", "(1000000000000000, 0)"}) {
    std::string dictionary =
        std::string("{'descr': '<f8', 'fortran_order': False, 'shape': ") + shape + ", }";
    dictionary.resize(117, ' ');
    const std::string file = folder.write("a.npy", std::string("\x93NUMPY\x01\x00\x76\x00", 10) + dictionary +
                                                       "\n" + std::string(64, 'x'));
    EXPECT_THAT(complaint<ReadError>([&] { NpyReader<double> reader(file); }),
                HasSubstr("shorter than its header says"))
        << shape;
  }
}

} // namespace
} // namespace hopmesh::tests
