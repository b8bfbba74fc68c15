// What `sweep` and `stability` have in common: a study, and how its points are run.
#pragma once

#include "sim/study/study_run.h"

#include <CLI/CLI.hpp>

namespace hopmesh::cli {

struct StudyOptions {
  std::string study, out, executor = "local", share;
  std::int64_t workers = 0; ///< 0: as many as processors
  std::string verb;         ///< for commands that go on
};

/// STUDY, --out, -j, --executor, --share.
void add_study(CLI::App& verb, StudyOptions& options);

/// Throws input::InputError for a --share that is none.
study::StudyOrder order_of(const StudyOptions& options, const study::Study& study);

} // namespace hopmesh::cli
