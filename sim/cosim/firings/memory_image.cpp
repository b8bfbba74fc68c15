#include "sim/cosim/firings/memory_image.h"

#include "sim/input/input_error.h"
#include "sim/input/line_reader.h"
#include "sim/input/number.h"
#include "sim/input/whole_file.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cosim {

namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 33;

/// Words of a text without its comments, one after the other.
class MemoryText {
 public:
  MemoryText(std::string path, std::size_t cells, int bits, bool negative)
      : path_(std::move(path)), bits_(bits), negative_(negative), memory_(cells) {}

  std::vector<Cell> read() {
    const std::string text = without_comments(input::read_whole_file(path_, "a memory", most_bytes));
    for (input::LineReader lines(text); lines.next();) {
      line_ = lines.number();
      input::Words words(lines.line());
      for (std::string_view word = words.next(); !word.empty(); word = words.next()) take(std::string(word));
    }
    return std::move(memory_);
  }

 private:
  // Blanks stand where comments stood; ends of lines stay.
  static std::string without_comments(std::string text) {
    for (std::size_t at = text.find('/'); at != std::string::npos; at = text.find('/', at + 1)) {
      const bool block = text.compare(at, 2, "/*") == 0;
      if (!block && text.compare(at, 2, "//") != 0) continue;
      const std::size_t close = text.find(block ? "*/" : "\n", at + 2);
      const std::size_t end = close == std::string::npos ? text.size() : close + (block ? 2 : 0);
      for (std::size_t k = at; k < end; ++k)
        if (text[k] != '\n') text[k] = ' ';
    }
    return text;
  }

  void take(std::string word) {
    word.erase(std::remove(word.begin(), word.end(), '_'), word.end());
    const bool address = !word.empty() && word[0] == '@';
    if (!address && word.find_first_of("xXzZ") != std::string::npos) {
      at_ += 1;
      return;
    }
    const std::uint64_t value = hexadecimal(address ? word.substr(1) : word);
    if (address) {
      at_ = value;
      return;
    }
    if (at_ >= memory_.size())
      fail(fmt::format("a word for address {}", at_), fmt::format("{} words", memory_.size()));
    if (value >> bits_ != 0) fail(input::in_quotes(word), fmt::format("a word of {} bits", bits_));
    memory_[at_++] = with_sign(value);
  }

  std::uint64_t hexadecimal(const std::string& digits) const {
    std::uint64_t value = 0;
    if (!input::parse_number(digits, value, 16)) fail(input::in_quotes(digits), "hexadecimal digits");
    return value;
  }

  std::int64_t with_sign(std::uint64_t value) const {
    const bool below_zero = negative_ && (value >> (bits_ - 1) & 1) != 0;
    return static_cast<std::int64_t>(below_zero ? value | (~std::uint64_t{0} << bits_) : value);
  }

  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw input::input_error(path_, line_, "", found, expected);
  }

  const std::string path_;
  const int bits_;
  const bool negative_;
  std::vector<Cell> memory_;
  std::uint64_t at_ = 0;
  int line_ = 0;
};

} // namespace

std::string memory_word(std::int64_t code, int bits) {
  const std::uint64_t kept = static_cast<std::uint64_t>(code) & (~std::uint64_t{0} >> (64 - bits));
  return fmt::format("{:0{}x}", kept, (bits + 3) / 4);
}

std::vector<Cell> read_memory(const std::string& path, std::size_t cells, int bits, bool negative) {
  return MemoryText(path, cells, bits, negative).read();
}

} // namespace hopmesh::cosim
