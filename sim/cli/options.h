// What the verbs have in common: exit codes, the scene with its array and overrides, where results go.
#pragma once

#include "sim/cli/checks.h"
#include "sim/input/command_words.h"
#include "sim/levels/prepared.h"
#include "sim/run/outcome.h"

#include <filesystem>

namespace hopmesh::cli {

/// Exit codes of the program.
enum Exit : int { done = 0, differs = 1, bad_input = 2, interrupted = 130 };

/// Of a program whose work ended so.
int exit_of(run::Outcome outcome);

/// SCENE, --array, --set.
void add_common(CLI::App& verb, input::InputWords& words);

/// A line each on stderr, about what is no mistake.
void tell(const std::vector<std::string>& notes);

/// Reads and checks everything, the array's rules for this very mesh included, and tells which keys have no
/// effect. Throws input::InputError.
levels::Prepared prepare(const input::InputWords& words);
/// Throws input::InputError for a --step that the scene has not.
void check_step(std::int64_t step, const levels::Prepared& prepared);

/// What --out says; where it says nothing, out/NAME. A slash in a name must not lead elsewhere.
std::filesystem::path results_folder(const std::string& out, std::string name);
/// What -j says; where it says nothing, as many as processors.
std::size_t workers_of(std::int64_t asked);

} // namespace hopmesh::cli
