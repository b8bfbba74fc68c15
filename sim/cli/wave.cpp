#include "sim/cli/wave.h"

#include "sim/record/output_file.h"
#include "sim/scene/input_error.h"
#include "sim/scene/limits.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <regex>
#include <sysc/tracing/sc_tracing_ids.h>

namespace hopmesh::cli {

void parse_window(const std::string& text, WaveRequest& request) {
  static const std::regex shape(R"((\d{0,18}):(\d{0,18})(c?))");
  std::smatch part;
  if (!std::regex_match(text, part, shape))
    throw scene::input_error("", 0, "--wave-window", text, "FROM:TO in steps, or FROM:TOc in cycles");
  request.first = part[1].length() ? std::stoull(part[1]) : 0;
  request.last = part[2].length() ? std::stoull(part[2]) : UINT64_MAX;
  request.in_cycles = part[3].length() > 0;
  if (request.first >= request.last)
    throw scene::input_error("", 0, "--wave-window", text, "a window that begins before it ends");
}

std::vector<std::size_t> parse_cells(const std::string& text) {
  static const std::regex list(R"(\d{1,9}(-\d{1,9})?(,\d{1,9}(-\d{1,9})?)*)"), item(R"((\d+)(?:-(\d+))?)");
  if (!std::regex_match(text, list))
    throw scene::input_error("", 0, "--wave-cells", text, "cells like 0,4,10-12");
  std::vector<std::size_t> cells;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), item); at != std::sregex_iterator(); ++at) {
    const std::size_t first = std::stoul((*at)[1]), last = (*at)[2].matched ? std::stoul((*at)[2]) : first;
    if (first > last || last >= static_cast<std::size_t>(scene::most_nodes))
      throw scene::input_error("", 0, "--wave-cells", at->str(), "a rising range of cells that exist");
    for (std::size_t c = first; c <= last; ++c) cells.push_back(c);
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

Wave::Wave(WaveRequest request, systemc::Device& device, const sc_core::sc_signal<bool>& irq,
           systemc::Waking waking)
    : request_(std::move(request)), device_(device), irq_(irq), waking_(waking) {
  const std::size_t cells = device.cells.topology().cells();
  for (std::size_t c : request_.cells)
    if (c >= cells)
      throw scene::input_error("", 0, "--wave-cells", std::to_string(c),
                               fmt::format("cells below {}", cells));
  if (std::filesystem::is_directory(request_.file))
    throw scene::input_error("", 0, "--wave", "the folder " + request_.file, "the name of a file");
  const auto folder = std::filesystem::absolute(request_.file).parent_path();
  record::check_writable(folder, 1 << 20);
  if (request_.in_cycles) walk({request_.first, request_.last});
}

Wave::~Wave() {
  if (file_) close();
  if (began_ && !done_)
    fmt::print(stderr, "hopmesh: {}: no wave, the run ended before the window began\n", request_.file);
}

void Wave::open() {
  // SystemC would tell stdout, where results go, which unit of time was set.
  sc_core::sc_report_handler::set_actions(sc_core::SC_ID_TRACING_TIMESCALE_UNIT_, sc_core::SC_DO_NOTHING);
  file_ = sc_core::sc_create_vcd_trace_file((request_.file + ".part").c_str());
  const bool whole = device_.cells.period().value() % 2000 == 0; // half a cycle is so many nanoseconds
  file_->set_time_unit(1, whole ? sc_core::SC_NS : sc_core::SC_PS);
  sc_core::sc_trace(file_, irq_, std::string(device_.name()) + ".irq");
  device_.cells.sequencer.trace(file_);
  if (request_.cells.empty())
    for (std::size_t c = 0; c < device_.cells.topology().cells(); ++c) device_.cells.cell(c).trace(file_);
  for (std::size_t c : request_.cells) device_.cells.cell(c).trace(file_);
}

void Wave::close() {
  sc_core::sc_close_vcd_trace_file(file_);
  file_ = nullptr;
  done_ = true;
  const std::string part = request_.file + ".part.vcd"; // SystemC adds the ending
  std::error_code error;
  std::filesystem::rename(part, request_.file, error);
  if (error) trouble_ = request_.file + ": " + error.message();
}

// An array that is woken by every clock anyway stays so.
void Wave::walk(systemc::CycleWindow window) {
  if (waking_ == systemc::Waking::by_phase) device_.walk(window);
}

void Wave::mind_the_disk() {
  constexpr std::uintmax_t least = 64u << 20; // more than a slice of a thousand cycles can write
  if (!file_) return;
  std::error_code error;
  const auto space = std::filesystem::space(std::filesystem::absolute(request_.file).parent_path(), error);
  if (error || space.available >= least) return;
  walk({});
  close();
  trouble_ = request_.file + ": the wave ends early, its disk is nearly full (less than 64 MB left)";
}

void Wave::begin_step(std::uint64_t step) {
  began_ = true;
  if (request_.in_cycles || file_ || done_ || step < request_.first || step >= request_.last) return;
  open();
  walk({device_.cells.sequencer.total_cycles(), UINT64_MAX});
}

void Wave::end_step(std::uint64_t step) {
  if (!file_) return;
  if (request_.in_cycles ? device_.cells.sequencer.total_cycles() < request_.last : step + 1 < request_.last)
    return;
  walk({});
  close();
}

std::optional<sc_core::sc_time> Wave::next_change(sc_core::sc_time began, std::uint64_t cycles_before) const {
  if (!request_.in_cycles || done_) return std::nullopt;
  const std::uint64_t cycle = std::max(file_ ? request_.last : request_.first, cycles_before);
  if (cycle == UINT64_MAX) return std::nullopt;
  // Half-way between two edges: an edge belongs to the cycle that it ends.
  const auto at = began + device_.cells.period() * (static_cast<double>(cycle - cycles_before) + 0.5);
  const auto now = sc_core::sc_time_stamp();
  return at > now ? at - now : sc_core::SC_ZERO_TIME;
}

void Wave::change() {
  if (file_)
    close();
  else
    open();
}

} // namespace hopmesh::cli
