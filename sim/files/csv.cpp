// Comma-separated values; the digits come from fmt's shortest round trip.
#include "sim/files/csv.h"

#include <fmt/format.h>
#include <stdexcept>

namespace hopmesh::files {
namespace {

std::string quoted(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string result = "\"";
  for (const char c : text) result.append(c == '"' ? 2 : 1, c);
  return result + '"';
}

} // namespace

std::string shortest(double value) {
  return fmt::format("{}", value);
}

CsvWriter::CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& header)
    : file_(path), columns_(header.size()) {
  for (const auto& name : header) cell(std::string_view(name));
  end_row();
}

CsvWriter::CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& header, CheckedRows)
    : file_(path), columns_(header.size()) {
  for (const auto& name : header) cell(std::string_view(name));
  line_ += ",check";
  end_row();
  checked_ = true;
}

std::string check_of_row(std::string_view text) {
  RunningCheck check;
  check.add(text.data(), text.size());
  return fmt::format("{:016x}", check.value());
}

CsvWriter& CsvWriter::raw(std::string_view text) {
  if (filled_++ > 0) line_ += ',';
  line_ += text;
  return *this;
}

CsvWriter& CsvWriter::cell(double value) {
  char digits[32]; // the longest takes 24
  return raw({digits, static_cast<std::size_t>(fmt::format_to(digits, "{}", value) - digits)});
}

CsvWriter& CsvWriter::cell(std::string_view text) {
  return raw(quoted(text));
}

void CsvWriter::end_row() {
  if (filled_ != columns_)
    throw std::logic_error(
        fmt::format("{}: a row of {} cells under a header of {}", file_.path().string(), filled_, columns_));
  if (checked_) line_ += ',' + check_of_row(line_);
  line_ += '\n';
  file_.write(line_);
  line_.clear();
  filled_ = 0;
}

void CsvWriter::row(const std::vector<double>& values) {
  for (const double value : values) cell(value);
  end_row();
}

} // namespace hopmesh::files
