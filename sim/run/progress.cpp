#include "sim/run/progress.h"

#include "sim/input/standard_streams.h"
#include "sim/levels/interrupt.h"

#include <fmt/format.h>
#include <unistd.h>

namespace hopmesh::run {

using Clock = std::chrono::steady_clock;

Progress::Progress(std::uint64_t steps, std::uint64_t before)
    : steps_(steps), before_(before), shown_(isatty(STDERR_FILENO)), began_(Clock::now()) {}

Progress::~Progress() {
  if (shown_) input::say("\r\033[K");
}

void Progress::step(const levels::StepRow& row, const levels::Mover&) {
  step(row);
}

void Progress::step(const levels::StepRow& row) {
  const auto now = Clock::now();
  if (!shown_ || (now - drawn_ < std::chrono::milliseconds(100) && row.step + 1 < steps_)) return;
  drawn_ = now;
  draw(row, now);
}

void Progress::say(const std::string& line) {
  input::say(fmt::format("{}{}\n", shown_ ? "\r\033[K" : "", line));
  drawn_ = {};
}

void Progress::draw(const levels::StepRow& row, Clock::time_point now) {
  constexpr std::size_t width = 32;
  const std::uint64_t done = row.step + 1;
  const double seconds = std::chrono::duration<double>(now - began_).count();
  const double left = seconds / static_cast<double>(done - before_) * static_cast<double>(steps_ - done);
  const std::size_t full = width * done / steps_;
  input::say(fmt::format("\r\033[K[{:=<{}}{:<{}}] step {} of {}, {} sweeps, strain {:.0f} %, {:.0f} s left",
                         "", full, "", width - full, done, steps_, row.sweeps, 100 * row.max_strain, left));
}

RunResult simulate_shown(levels::Mover& motion, std::uint64_t steps, std::vector<StepSink*> sinks) {
  Progress progress(steps);
  sinks.push_back(&progress);
  return simulate(motion, steps, sinks, levels::stop_requested);
}

CountProgress::CountProgress(const char* what, std::uint64_t total)
    : what_(what), total_(total), shown_(isatty(STDERR_FILENO)), began_(Clock::now()) {}

CountProgress::~CountProgress() {
  if (shown_) input::say("\r\033[K");
}

void CountProgress::count(std::uint64_t done) {
  const auto now = Clock::now();
  if (!shown_ || now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  const double seconds = std::chrono::duration<double>(now - began_).count();
  const double rate = seconds > 0 ? static_cast<double>(done) / seconds : 0;
  std::string line = fmt::format("\r\033[K{}{} {}, {:.0f} s, {:.0f}/s", done,
                                 total_ > 0 ? fmt::format(" of {}", total_) : "", what_, seconds, rate);
  if (total_ > done && rate > 0)
    line += fmt::format(", {:.0f} s left", static_cast<double>(total_ - done) / rate);
  input::say(line);
}

} // namespace hopmesh::run
