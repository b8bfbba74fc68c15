#include "tests/campaigns/mutants/mutation.h"

#include <algorithm>
#include <cstring>

namespace hopmesh::campaigns {

namespace {

constexpr std::size_t longest = 200'000;

/// A piece of bytes: where it begins, and how long it is.
struct Piece {
  std::size_t at, size;
};

/// Short pieces are common; a quarter of them may be of any length.
Piece piece_of(const std::string& bytes, Random& random) {
  const std::size_t at = below(bytes.size(), random), most = bytes.size() - at;
  return {at, 1 + below(below(4, random) ? std::min<std::size_t>(most, 8) : most, random)};
}

/// The line that holds a byte, with its end.
Piece line_of(const std::string& bytes, Random& random) {
  const std::size_t inside = below(bytes.size(), random);
  const std::size_t before = inside == 0 ? std::string::npos : bytes.rfind('\n', inside - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  const std::size_t end = std::min(bytes.find('\n', inside), bytes.size() - 1);
  return {begin, end + 1 - begin};
}

bool is_of_number(char c) {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e' || c == 'E';
}

bool is_of_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || is_of_number(c);
}

/// The run of such characters that is first behind a byte; of no length where there is none.
Piece run_of(const std::string& bytes, bool (*belongs)(char), Random& random) {
  if (bytes.empty()) return {0, 0};
  const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size(), random));
  const auto begin = std::find_if(from, bytes.end(), belongs);
  const auto end = std::find_if_not(begin, bytes.end(), belongs);
  return {static_cast<std::size_t>(begin - bytes.begin()), static_cast<std::size_t>(end - begin)};
}

const std::string& one_of(const Seeds& texts, Random& random) {
  return texts[below(texts.size(), random)];
}

void flip_a_bit(std::string& bytes, const Seeds&, Random& random) {
  char& byte = bytes[below(bytes.size(), random)];
  byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1u << below(8, random)));
}

void change_a_byte(std::string& bytes, const Seeds&, Random& random) {
  static const std::string telling("\0\xff\x7f\x80\n\r\t \"',;#=[]{}()<>%/\\-+.eE019", 34);
  const bool any = below(3, random) == 0;
  bytes[below(bytes.size(), random)] =
      any ? static_cast<char>(random()) : telling[below(telling.size(), random)];
}

void cut_the_end(std::string& bytes, const Seeds&, Random& random) {
  bytes.resize(below(bytes.size(), random));
}

void cut_a_piece(std::string& bytes, const Seeds&, Random& random) {
  const Piece piece = piece_of(bytes, random);
  bytes.erase(piece.at, piece.size);
}

void repeat_a_piece(std::string& bytes, const Seeds&, Random& random) {
  const Piece piece = piece_of(bytes, random);
  const std::string copy = bytes.substr(piece.at, piece.size);
  const std::size_t times = copy.size() > 64 ? 1 : 1 + below(1 + below(64, random), random);
  for (std::size_t k = 0; k < times; ++k) bytes.insert(piece.at, copy);
}

void splice(std::string& bytes, const Seeds& seeds, Random& random) {
  const std::string& other = one_of(seeds, random);
  bytes.resize(below(bytes.size() + 1, random));
  bytes += other.substr(below(other.size() + 1, random));
}

void insert_of_another(std::string& bytes, const Seeds& seeds, Random& random) {
  const std::string& other = one_of(seeds, random);
  if (other.empty()) return;
  const Piece piece = piece_of(other, random);
  bytes.insert(below(bytes.size() + 1, random), other, piece.at, std::min<std::size_t>(piece.size, 5000));
}

void make_a_number_extreme(std::string& bytes, const Seeds&, Random& random) {
  static const Seeds extremes{
      "0",          "-0",         "-1",         "1",
      "1e308",      "-1e308",     "1e400",      "1e-320",
      "1e-400",     "nan",        "-nan",       "inf",
      "-inf",       "1e15",       "-1e15",      "1e-15",
      "255",        "256",        "32768",      "65535",
      "65536",      "2147483647", "2147483648", "-2147483648",
      "4294967295", "4294967296", "4294967297", "9223372036854775807",
      "0.5",        "0x10",       "1D3",        "9223372036854775808",
      "1e9",        "1,5",        "+7",         "-9223372036854775808",
      "007",        "2",          "",           "18446744073709551615",
      "-3",         "1e",         "--1",        "18446744073709551616",
      "1e18",       "1e19",       "999999",     "99999999999999999999999999999999999999999"};
  const Piece number = run_of(bytes, is_of_number, random);
  bytes.replace(number.at, number.size, one_of(extremes, random));
}

void swap_a_word(std::string& bytes, const Seeds& seeds, Random& random) {
  const std::string& other = below(2, random) ? bytes : one_of(seeds, random);
  const Piece from = run_of(other, is_of_word, random), to = run_of(bytes, is_of_word, random);
  bytes.replace(to.at, to.size, std::string(other, from.at, from.size));
}

void double_a_line(std::string& bytes, const Seeds&, Random& random) {
  const Piece line = line_of(bytes, random);
  bytes.insert(line.at, bytes.substr(line.at, line.size));
}

void drop_a_line(std::string& bytes, const Seeds&, Random& random) {
  const Piece line = line_of(bytes, random);
  bytes.erase(line.at, line.size);
}

void move_a_line(std::string& bytes, const Seeds& seeds, Random& random) {
  const std::string& other = below(2, random) ? bytes : one_of(seeds, random);
  if (other.empty()) return;
  const Piece from = line_of(other, random);
  const std::string line(other, from.at, from.size);
  bytes.insert(line_of(bytes, random).at, line);
}

// Counts, sizes and offsets of binary files have four or eight bytes, in either order.
void make_an_integer_extreme(std::string& bytes, const Seeds&, Random& random) {
  static const std::uint64_t extremes[] = {
      0,          1,           0x7f,        0xff,      0x7fff,     0xffff,     0x7fffffff,
      0x80000000, 0xffffffff,  0x100000000, INT64_MAX, UINT64_MAX, 0xfffffff0, 0x7ff0'0000ull << 32,
      0x10000000, 0x0001000000};
  const std::uint64_t value = extremes[below(std::size(extremes), random)];
  const std::size_t size = below(2, random) ? 4 : 8;
  if (bytes.size() < size) return;
  char raw[8];
  std::memcpy(raw, &value, sizeof raw);
  if (below(2, random)) std::reverse(raw, raw + size);
  bytes.replace(below(bytes.size() - size + 1, random), size, raw, size);
}

} // namespace

const std::vector<Change>& changes() {
  static const std::vector<Change> all{{"a bit flipped", flip_a_bit},
                                       {"a byte changed", change_a_byte},
                                       {"the end cut", cut_the_end},
                                       {"a piece cut", cut_a_piece},
                                       {"a piece repeated", repeat_a_piece},
                                       {"spliced", splice},
                                       {"a piece of another inserted", insert_of_another},
                                       {"a number made extreme", make_a_number_extreme},
                                       {"a word swapped", swap_a_word},
                                       {"a line doubled", double_a_line},
                                       {"a line dropped", drop_a_line},
                                       {"a line moved", move_a_line},
                                       {"an integer made extreme", make_an_integer_extreme}};
  return all;
}

std::string mutant_of(const Seeds& seeds, Random& random) {
  std::string bytes = one_of(seeds, random);
  const std::size_t some = below(4, random) ? 1 : 1 + below(8, random);
  for (std::size_t k = 0; k < some && !bytes.empty(); ++k)
    changes()[below(changes().size(), random)].apply(bytes, seeds, random);
  if (bytes.size() > longest) bytes.resize(longest);
  return bytes;
}

} // namespace hopmesh::campaigns
