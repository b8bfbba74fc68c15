// A run in its folder: begun anew or behind a checkpoint, flown to its end, and told.
#pragma once

#include "sim/run/run_files.h"

namespace hopmesh::run {

/// What is asked of a run. A resumed run has level, command and check from its checkpoint.
struct FlightPlan {
  const levels::Level* level = nullptr;
  std::string command;     ///< that repeats it
  bool check = false;      ///< ask the reference beside every step
  std::int64_t steps = 0;  ///< in place of the scene's number of steps; 0: the scene's
  std::uint64_t every = 0; ///< a checkpoint after so many steps; 0: as before, or only when interrupted
  levels::PortRequest port;
};

class Flight {
 public:
  Flight(levels::Prepared prepared, const std::filesystem::path& folder, const FlightPlan& plan);
  /// Behind what is there. `plan.steps` must be more than are done.
  Flight(ResumedRun found, const std::filesystem::path& folder, const FlightPlan& plan);
  Flight(const Flight&) = delete;
  Flight& operator=(const Flight&) = delete;

  /// Does the steps that are left, until the user stops them, and writes all files. Throws files::WriteError.
  RunResult fly();
  /// The end in lines for people.
  std::string text_of(const RunResult& result) const;
  /// What went wrong without touching the results, in one line; "" where nothing did.
  std::string trouble() const;

 private:
  RunResult fly_steps();

  const levels::Prepared prepared_;
  const levels::ReadyLevel level_;
  const std::uint64_t every_;
  RunResult earlier_; ///< what was done before
  RunFiles files_;
  std::string unsafe_; ///< why an interrupted run cannot be gone on with where it ended, if so
};

} // namespace hopmesh::run
