// Matrix Market files: the same bits back, what other programs write, and broken files told in a line.
#include "sim/files/matrix_market.h"
#include "sim/input/input_error.h"
#include "tests/support/complaint.h"
#include "tests/support/files.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <limits>
#include <random>
#include <sys/resource.h>

namespace hopmesh::tests {
namespace {

using namespace files;

using testing::HasSubstr;

std::string text_of(const MatrixEntry& e) {
  return std::to_string(e.row) + ',' + std::to_string(e.column) + '=' + std::to_string(e.value);
}

class MatrixMarket : public testing::Test {
 protected:
  std::string file(const std::string& text) const { return folder_.write("m.mtx", text); }
  SparseMatrix read(const std::string& text) const { return read_matrix(file(text)); }

  static void expect_entries(const SparseMatrix& m, const std::vector<MatrixEntry>& expected) {
    ASSERT_EQ(m.entries.size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_EQ(m.entries[k].row, expected[k].row) << text_of(m.entries[k]);
      EXPECT_EQ(m.entries[k].column, expected[k].column) << text_of(m.entries[k]);
      EXPECT_EQ(m.entries[k].value, expected[k].value) << text_of(m.entries[k]);
    }
  }

  std::string refusal(const std::string& text, bool vector = false) const {
    const std::string path = file(text);
    const std::string what = complaint([&] { vector ? (void)read_vector(path) : (void)read_matrix(path); });
    if (what.empty()) return "read";
    EXPECT_EQ(what.rfind(path, 0), 0u) << what;
    return what.substr(path.size());
  }

  Folder folder_;
};

/// Any bits that are a finite double.
double any_double(std::mt19937_64& dice) {
  for (;;) {
    const std::uint64_t bits = dice();
    double x;
    std::memcpy(&x, &bits, sizeof x);
    if (std::isfinite(x)) return x;
  }
}

TEST_F(MatrixMarket, DoublesComeBackBitForBit) {
  std::mt19937_64 dice(20261124);
  using limits = std::numeric_limits<double>;
  std::vector<double> values{0.1, -0.0, limits::denorm_min(), limits::max(), limits::min(), 1.0 / 3};
  for (int k = 0; k < 2000; ++k) values.push_back(any_double(dice));
  write_vector(folder_ / "v.mtx", values);
  const auto back = read_vector((folder_ / "v.mtx").string());
  ASSERT_EQ(back.size(), values.size());
  for (std::size_t k = 0; k < values.size(); ++k) // zeros of a dense file are no entries: no sign of zero
    EXPECT_TRUE(back[k] == values[k]) << k << ' ' << values[k];

  std::vector<MatrixEntry> entries;
  for (std::size_t row = 0; row < 40; ++row)
    for (std::size_t column = row % 3; column < 50; column += 3)
      entries.push_back({row, column, any_double(dice)});
  write_matrix(folder_ / "w.mtx", 40, 50, entries);
  const SparseMatrix m = read_matrix((folder_ / "w.mtx").string());
  EXPECT_EQ(m.rows, 40u);
  EXPECT_EQ(m.columns, 50u);
  expect_entries(m, entries);
}

TEST_F(MatrixMarket, CoordinatesInAnyOrderWithCommentsAndBlankLines) {
  expect_entries(read("%%MatrixMarket matrix coordinate real general\n% by hand\n\n2 3 3\n"
                      "2 1 +1.5e2\r\n  1\t3 -4 \n%\n1 1 7\n\n"),
                 {{0, 0, 7}, {0, 2, -4}, {1, 0, 150}});
}

TEST_F(MatrixMarket, BothHalvesOfASymmetricOne) {
  expect_entries(read("%%matrixmarket MATRIX Coordinate Integer Symmetric\n2 2 2\n1 1 5\n2 1 -3\n"),
                 {{0, 0, 5}, {0, 1, -3}, {1, 0, -3}});
}

TEST_F(MatrixMarket, APatternsValuesAreOne) {
  expect_entries(read("%%MatrixMarket matrix coordinate pattern general\n2 2 2\n1 2\n2 2\n"),
                 {{0, 1, 1}, {1, 1, 1}});
}

TEST_F(MatrixMarket, TheOtherHalfOfASkewOneIsNegative) {
  expect_entries(read("%%MatrixMarket matrix coordinate real skew-symmetric\n3 3 2\n2 1 -1.5\n3 2 2\n"),
                 {{0, 1, 1.5}, {1, 0, -1.5}, {1, 2, -2}, {2, 1, 2}});
  expect_entries(read("%%MatrixMarket matrix array integer skew-symmetric\n3 3\n1\n0\n3\n"),
                 {{0, 1, -1}, {1, 0, 1}, {1, 2, -3}, {2, 1, 3}});
}

TEST_F(MatrixMarket, ABannerOfOnePercentAByteOrderMarkAndFortransNumbers) {
  for (const char* banner : {"%MatrixMarket", "\xEF\xBB\xBF%%MatrixMarket", "%matrixmarket"})
    expect_entries(
        read(std::string(banner) + " matrix coordinate real general\r2 2 2\r1 1 -1.5D+01\r2 1 1e-400\r"),
        {{0, 0, -15}, {1, 0, 0}});
}

TEST_F(MatrixMarket, IntegersMayHaveASign) {
  expect_entries(
      read("%%MatrixMarket matrix coordinate integer general\n2 2 2\n1 1 +7\n2 1 -12345678901234567890\n"),
      {{0, 0, 7}, {1, 0, -12345678901234567890.0}});
}

TEST_F(MatrixMarket, ArraysGoColumnByColumn) {
  expect_entries(read("%%MatrixMarket matrix array real general\n2 2\n1\n2\n0\n4\n"),
                 {{0, 0, 1}, {1, 0, 2}, {1, 1, 4}});
  expect_entries(read("%%MatrixMarket matrix array real symmetric\n2 2\n1\n2\n4\n"),
                 {{0, 0, 1}, {0, 1, 2}, {1, 0, 2}, {1, 1, 4}});
}

TEST_F(MatrixMarket, AVectorMayBeSparse) {
  const std::string path = file("%%MatrixMarket matrix coordinate real general\n3 1 1\n2 1 0.5\n");
  EXPECT_EQ(read_vector(path), (std::vector<double>{0, 0.5, 0}));
}

// Forty bytes that ask for 16 GB: their rows are compared before room is made for them.
TEST_F(MatrixMarket, AVectorOfAnotherSizeTakesNoRoom) {
  const std::string path = file("%%MatrixMarket matrix coordinate integer general\n2147483648 1 0\n");
  rlimit before{};
  getrlimit(RLIMIT_DATA, &before);
  const rlimit little{std::min<rlim_t>(before.rlim_max, 1u << 30), before.rlim_max};
  setrlimit(RLIMIT_DATA, &little);
  const std::string what = complaint([&] { read_vector(path, RowsWanted{3, "as W has"}); });
  setrlimit(RLIMIT_DATA, &before);
  EXPECT_THAT(what, HasSubstr("found 2147483648 rows, expected 3, as W has"));
}

TEST_F(MatrixMarket, MistakesOfOneFieldOrHalfAreToldToo) {
  const std::vector<std::pair<std::string, std::string>> broken{
      {"%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n2 1 1\n2 1 2\n",
       ":4: found row 2, column 1 twice"},
      {"%%MatrixMarket matrix coordinate integer general\n1 1 1\n1 1 -1.5\n",
       ":3: found \"-1.5\", expected an integer, as the banner says"},
      {"%%MatrixMarket matrix array integer general\n1 1\n1e3\n", ":3: found \"1e3\", expected an integer"},
      {"%%MatrixMarket matrix coordinate real skew-symmetric\n2 2 1\n1 1 1\n",
       ":3: found row 1, column 1, expected the half below the diagonal alone"},
      {"%%MatrixMarket matrix coordinate pattern skew-symmetric\n2 2 1\n2 1\n",
       ":1: found \"skew-symmetric\""},
      {"%%MatrixMarket matrix coordinate real skew-symmetric\n2 3 1\n2 1 1\n",
       ":2: found 2 x 3, skew-symmetric"},
  };
  for (const auto& [text, says] : broken) EXPECT_THAT(refusal(text), HasSubstr(says)) << text;
}

TEST_F(MatrixMarket, EveryMistakeIsToldWithItsLine) {
  const std::string real = "%%MatrixMarket matrix coordinate real general\n";
  const std::vector<std::pair<std::string, std::string>> broken{
      {"hello\n", ":1: found \"hello\", expected %%MatrixMarket matrix"},
      {"%%MatrixMarket tensor coordinate real general\n1 1 0\n", ":1: found \"tensor\", expected matrix"},
      {"%%MatrixMarket matrix coordinat real general\n1 1 0\n", "(did you mean coordinate?)"},
      {"%%MatrixMarket matrix coordinate complex general\n1 1 0\n", ":1: found \"complex\""},
      {"%%MatrixMarket matrix array pattern general\n1 1\n", ":1: found \"pattern\", expected real, integer"},
      {"%%MatrixMarket matrix coordinate real hermitian\n1 1 0\n", ":1: found \"hermitian\""},
      {"%%MatrixMarket matrix coordinate real\n1 1 0\n", ":1: found the banner's end"},
      {"%%MatrixMarket matrix coordinate real general today\n1 1 0\n", ":1: found \"today\""},
      {real, "found the end of the file, expected a line with the sizes"},
      {real + "% only\n", "expected a line with the sizes"},
      {real + "2 2\n1 1 1\n", ":2: found the end of the line, expected the number of entries"},
      {real + "2 2 x\n", ":2: found \"x\""},
      {real + "-2 2 1\n", ":2: found \"-2\", expected the number of rows"},
      {real + "0 0 0\n", ":2: found \"0\""},
      {real + "2 2 5\n", ":2: found \"5\", expected the number of entries, an integer from 0 to 4"},
      {real + "2 2 1 1\n", ":2: found \"1\", expected the end of the line"},
      {real + "2 2 2\n1 1 1\n", "found the end of the file after 1 entries, expected 2 entries"},
      {real + "2 2 1\n1 1 1\n2 2 2\n", ":4: found \"2 2 2\", expected the end, after 1 entries"},
      {real + "2 2 1\n3 1 1\n", ":3: found \"3\", expected a row, an integer from 1 to 2"},
      {real + "2 2 1\n1 0 1\n", ":3: found \"0\", expected a column"},
      {real + "2 2 1\n1.5 1 1\n", ":3: found \"1.5\""},
      {real + "2 2 1\n1 1\n", ":3: found the end of the line, expected a finite number"},
      {real + "2 2 1\n1 1 nan\n", ":3: found \"nan\", expected a finite number"},
      {real + "2 2 1\n1 1 -inf\n", ":3: found \"-inf\""},
      {real + "2 2 1\n1 1 1e999\n", ":3: found \"1e999\""},
      {real + "2 2 1\n1 1 1,5\n", ":3: found \"1,5\""},
      {real + "2 2 1\n1 1 1 1\n", ":3: found \"1\", expected the end of the line"},
      {real + "2 2 2\n1 1 1\n1 1 2\n",
       ":4: found row 1, column 1 twice, first in line 3, expected each place once"},
      {real + "% c\n2 2 3\n1 2 1\n\n2 2 0\n1 2 2\n", ":7: found row 1, column 2 twice, first in line 4"},
      {"%%MatrixMarket matrix coordinate real symmetric\n2 2 1\n1 2 1\n", ":3: found row 1, column 2"},
      {"%%MatrixMarket matrix coordinate real symmetric\n2 3 1\n1 1 1\n", ":2: found 2 x 3, symmetric"},
      {"%%MatrixMarket matrix array real general\n2 1\n1\n", "after 1 entries, expected 2 entries"},
      {"%%MatrixMarket matrix array real general\n2 1\n1\n2\n3\n", ":5: found \"3\""},
      {"%%MatrixMarket matrix array real general\n2147483648 2147483648\n1\n", "found the end of the file"},
  };
  for (const auto& [text, says] : broken) EXPECT_THAT(refusal(text), HasSubstr(says)) << text;
  EXPECT_THAT(refusal("%%MatrixMarket matrix array real general\n1 2\n1\n2\n", true),
              HasSubstr("found 1 x 2, expected a vector: one column"));
}

/// A byte changed, left out or put in, a line doubled, or the end cut off.
std::string spoilt(std::string text, std::mt19937_64& dice) {
  const std::size_t at = dice() % text.size();
  const std::string bytes = std::string("0123456789+-.eE %\n\r\tx") + '\0' + '\xff';
  switch (dice() % 5) {
  case 0:
    text[at] = bytes[dice() % bytes.size()];
    return text;
  case 1:
    return text.erase(at, 1);
  case 2:
    return text.insert(at, 1, bytes[dice() % bytes.size()]);
  case 3:
    return text.insert(at, text.substr(text.rfind('\n', at) + 1));
  default:
    return text.substr(0, at);
  }
}

TEST_F(MatrixMarket, BrokenFilesAreReadWholeOrRefusedInOneLine) {
  const std::uint64_t seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 dice(seed);
  const std::vector<std::string> good{
      "%%MatrixMarket matrix coordinate real general\n% c\n3 3 4\n1 1 -2.5\n2 1 1e-3\n1 2 7\n3 3 12\n",
      "%%MatrixMarket matrix coordinate integer symmetric\n3 3 3\n1 1 -2\n2 1 1\n3 2 70\n",
      "%%MatrixMarket matrix array real general\n3 1\n0.25\n-1\n1e2\n"};
  std::size_t refused = 0;
  for (int k = 0; k < 3000; ++k) {
    std::string text = spoilt(good[dice() % good.size()], dice);
    while (!text.empty() && dice() % 2) text = spoilt(text, dice);
    if (text.empty()) continue;
    try {
      const SparseMatrix m = read(text);
      for (const MatrixEntry& e : m.entries)
        ASSERT_TRUE(e.row < m.rows && e.column < m.columns && std::isfinite(e.value)) << text;
      for (std::size_t e = 1; e < m.entries.size(); ++e)
        ASSERT_LT(std::pair(m.entries[e - 1].row, m.entries[e - 1].column),
                  std::pair(m.entries[e].row, m.entries[e].column))
            << text;
    } catch (const input::InputError& e) {
      ++refused;
      ASSERT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
    }
  }
  EXPECT_GT(refused, 1000u);
}

} // namespace
} // namespace hopmesh::tests
