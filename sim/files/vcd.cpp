#include "sim/files/vcd.h"

#include <fmt/format.h>

namespace hopmesh::files {

namespace {

/// Short names for signals, of the characters that the format allows.
std::string code_of(std::size_t number) {
  constexpr std::size_t characters = 94; // '!' to '~'
  std::string code;
  for (++number; number > 0; number = (number - 1) / characters)
    code += static_cast<char>('!' + (number - 1) % characters);
  return code;
}

} // namespace

VcdFile::VcdFile(const std::filesystem::path& path, std::uint64_t picoseconds)
    : file_(path), unit_(picoseconds) {
  file_.write(fmt::format("$version\n hopmesh\n$end\n$timescale\n 1 {}\n$end\n", unit_ == 1 ? "ps" : "ns"));
}

void VcdFile::open_scope(std::string_view name) {
  file_.write(fmt::format("$scope module {} $end\n", name));
}

void VcdFile::close_scope() {
  file_.write("$upscope $end\n");
}

std::size_t VcdFile::add(std::string_view name, int width) {
  signals_.push_back({code_of(signals_.size()), width, 0});
  const std::string range = width > 1 ? fmt::format(" [{}:0]", width - 1) : "";
  file_.write(fmt::format("$var wire {} {} {}{} $end\n", width, signals_.back().code, name, range));
  return signals_.size() - 1;
}

// Where times begin stands in words: a time stamp would not be told from one of a change.
void VcdFile::begin(std::uint64_t picoseconds) {
  time_ = picoseconds;
  begun_ = true;
  file_.write(fmt::format("$enddefinitions $end\n$comment\nValues at time {} follow.\n$end\n$dumpvars\n",
                          picoseconds / unit_));
  for (const Signal& signal : signals_) write_value(signal);
  file_.write("$end\n");
}

void VcdFile::change(std::size_t signal, std::int64_t value) {
  signals_[signal].value = value;
  if (!begun_) return;
  write_time();
  write_value(signals_[signal]);
}

void VcdFile::write_time() {
  if (written_time_ == time_) return;
  written_time_ = time_;
  char digits[24];
  char* const end = fmt::format_to(digits, "#{}\n", time_ / unit_);
  file_.write(digits, static_cast<std::size_t>(end - digits));
}

// Leading zeros may be left out; a negative code stands with all its bits.
void VcdFile::write_value(const Signal& signal) {
  char line[80], *at = line;
  const auto bits = static_cast<std::uint64_t>(signal.value);
  if (signal.width > 1) {
    *at++ = 'b';
    int count = signal.value < 0 ? signal.width : 64 - (bits == 0 ? 63 : __builtin_clzll(bits));
    while (count-- > 0) *at++ = (bits >> count & 1) != 0 ? '1' : '0';
    *at++ = ' ';
  } else {
    *at++ = (bits & 1) != 0 ? '1' : '0';
  }
  at = std::copy(signal.code.begin(), signal.code.end(), at);
  *at++ = '\n';
  file_.write(line, static_cast<std::size_t>(at - line));
}

void VcdFile::finish() {
  if (!begun_) begin(time_);
  write_time();
  file_.commit();
}

} // namespace hopmesh::files
