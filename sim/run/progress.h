// A bar on stderr while something long runs; silent when stderr is no terminal.
#pragma once

#include "sim/run/simulation.h"

#include <chrono>

namespace hopmesh::run {

class Progress : public StepSink {
 public:
  /// `before`: how many of the steps were done by an earlier process.
  explicit Progress(std::uint64_t steps, std::uint64_t before = 0);
  ~Progress() override;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void step(const levels::StepRow& row, const levels::Mover& motion) override;
  void step(const levels::StepRow& row);
  /// A line on stderr, terminal or not; the bar gives way.
  void say(const std::string& line);

 private:
  void draw(const levels::StepRow& row, std::chrono::steady_clock::time_point now);

  const std::uint64_t steps_, before_;
  const bool shown_;
  std::chrono::steady_clock::time_point began_, drawn_;
};

/// simulate() with a bar, until the user stops it.
RunResult simulate_shown(levels::Mover& motion, std::uint64_t steps, std::vector<StepSink*> sinks = {});

/// A bar for things that are counted; `total` 0: nobody knows how many.
class CountProgress {
 public:
  CountProgress(const char* what, std::uint64_t total);
  ~CountProgress();
  CountProgress(const CountProgress&) = delete;
  CountProgress& operator=(const CountProgress&) = delete;

  void count(std::uint64_t done);

 private:
  const char* const what_;
  const std::uint64_t total_;
  const bool shown_;
  std::chrono::steady_clock::time_point began_, drawn_;
};

} // namespace hopmesh::run
