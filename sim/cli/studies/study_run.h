// What `sweep` and `stability` have in common: the points of a study into a folder, here or by Slurm.
#pragma once

#include "sim/study/point_runner.h"
#include "sim/study/study_file.h"

#include <CLI/CLI.hpp>

namespace hopmesh::cli {

struct StudyOptions {
  std::string study, out, executor = "local", share;
  std::int64_t workers = 0; ///< 0: as many as processors
  std::string verb;         ///< for commands that go on
};

/// STUDY, --out, -j, --executor, --share.
void add_study(CLI::App& verb, StudyOptions& options);

/// Methods that a study may name: levels, rivals, and the truth, which lies in the study's folder.
study::Methods all_methods(const std::filesystem::path& folder);

/// Runs what is missing and, once nothing is, leaves results.csv. Returns an exit code; `folder`: where.
int run_study(const StudyOptions& options, const study::Study& study, std::filesystem::path& folder);

} // namespace hopmesh::cli
