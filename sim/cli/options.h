// What the verbs have in common: exit codes, the scene with its array and overrides, checks of flags.
#pragma once

#include "sim/cli/number_checks.h"
#include "sim/levels/prepared.h"

namespace hopmesh::cli {

/// Exit codes of the program.
enum Exit : int { done = 0, differs = 1, bad_input = 2, interrupted = 130 };

struct CommonOptions {
  std::string scene, array;
  std::vector<std::string> overrides;
};

/// SCENE, --array, --set.
void add_common(CLI::App& verb, CommonOptions& options);
/// SCENE and the flags of add_common as a shell takes them back.
std::string words_of(const CommonOptions& options);
/// A word in quotes where a shell would ask for them.
std::string shell_word(const std::string& word);

/// out/NAME; a slash in a name must not lead elsewhere.
std::string default_folder(std::string name);

/// A line each on stderr, about what is no mistake.
void tell(const std::vector<std::string>& notes);

/// Reads and checks everything, the array's rules for this very mesh included, and tells which keys have no
/// effect. Throws input::InputError.
levels::Prepared prepare(const CommonOptions& options);

/// Throws input::InputError for a name that is none of `names`; `flag` is where it stood.
void check_name(const std::string& name, const std::string& flag, const std::vector<std::string>& names);
/// Throws input::InputError for a name that no problem has; `where` it stood.
void check_problem(const std::string& name, const std::string& where);

} // namespace hopmesh::cli
