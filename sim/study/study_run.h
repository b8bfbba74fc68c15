// All points of a study into its folder, here or by Slurm.
#pragma once

#include "sim/run/outcome.h"
#include "sim/study/study_file.h"

#include <filesystem>

namespace hopmesh::study {

/// Every `of`-th point from `first` on; a whole study is 0/1.
struct StudyShare {
  std::size_t first = 0, of = 1;
  bool alone = true; ///< nobody else writes into the folder; not so where a share was asked for
};

struct StudyOrder {
  std::filesystem::path folder;
  std::size_t workers = 1; ///< at a time
  bool slurm = false;      ///< as many tasks as workers, else child processes
  StudyShare share;
  std::string verb, study; ///< of the command that goes on
};

struct StudyEnd {
  run::Outcome outcome; ///< failed: points are missing
  std::string text;     ///< for people
};
/// Runs what is missing and, once nothing is, leaves results.csv. Throws input::InputError before any work.
StudyEnd run_study(const Study& study, const StudyOrder& order);

} // namespace hopmesh::study
