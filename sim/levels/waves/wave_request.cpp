#include "sim/levels/waves/wave_request.h"

#include "sim/files/output_file.h"
#include "sim/input/input_error.h"
#include "sim/input/number.h"
#include "sim/input/standard_streams.h"
#include "sim/scene/limits.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <regex>

namespace hopmesh::levels {

void parse_window(const std::string& text, WaveRequest& request) {
  static const std::regex shape(R"((\d{0,18}):(\d{0,18})(c?))");
  std::smatch part;
  if (!std::regex_match(text, part, shape))
    throw input::input_error("", 0, "--wave-window", text, "FROM:TO in steps, or FROM:TOc in cycles");
  request.first = 0, request.last = UINT64_MAX;
  input::parse_number(part[1].str(), request.first); // an end left out is none
  input::parse_number(part[2].str(), request.last);
  request.in_cycles = part[3].length() > 0;
  if (request.first >= request.last)
    throw input::input_error("", 0, "--wave-window", text, "a window that begins before it ends");
}

std::vector<std::size_t> parse_cells(const std::string& text) {
  static const std::regex list(R"(\d{1,9}(-\d{1,9})?(,\d{1,9}(-\d{1,9})?)*)"), item(R"((\d+)(?:-(\d+))?)");
  if (!std::regex_match(text, list))
    throw input::input_error("", 0, "--wave-cells", text, "cells like 0,4,10-12");
  std::vector<std::size_t> cells;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), item); at != std::sregex_iterator(); ++at) {
    std::size_t first = 0;
    input::parse_number((*at)[1].str(), first);
    std::size_t last = first;
    input::parse_number((*at)[2].str(), last); // none: a single cell
    if (first > last || last >= static_cast<std::size_t>(scene::most_nodes))
      throw input::input_error("", 0, "--wave-cells", at->str(), "a rising range of cells that exist");
    for (std::size_t c = first; c <= last; ++c) cells.push_back(c);
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

namespace {

/// Endings of formats that wave viewers know and nobody here writes.
constexpr const char* other_formats[] = {".fst",  ".ghw", ".lxt", ".lx2", ".lxt2", ".vzt", ".evcd",
                                         ".fsdb", ".vpd", ".wlf", ".wdb", ".trn",  ".shm"};

void expect_vcd(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  for (const char* other : other_formats)
    if (ending == other)
      throw input::input_error("", 0, "--wave", file, "FILE.vcd: waves are written as VCD only");
}

} // namespace

void check_wave(const WaveRequest& request, std::size_t cells) {
  expect_vcd(request.file);
  for (std::size_t c : request.cells)
    if (c >= cells)
      throw input::input_error("", 0, "--wave-cells", std::to_string(c),
                               fmt::format("cells below {}", cells));
  if (std::filesystem::is_directory(request.file))
    throw input::input_error("", 0, "--wave", "the folder " + request.file, "the name of a file");
  files::check_writable(std::filesystem::absolute(request.file).parent_path(), 1 << 20);
}

bool disk_nearly_full(const WaveRequest& request) {
  constexpr std::uintmax_t least = 64u << 20; // more than a thousand cycles of a large array write
  std::error_code error;
  const auto space = std::filesystem::space(std::filesystem::absolute(request.file).parent_path(), error);
  return !error && space.available < least;
}

std::string early_end_text(const WaveRequest& request) {
  return request.file + ": the wave ends early, its disk is nearly full (less than 64 MB left)";
}

void warn_empty_window(const WaveRequest& request) {
  input::say(fmt::format("hopmesh: {}: no wave, the run ended before the window began\n", request.file));
}

} // namespace hopmesh::levels
