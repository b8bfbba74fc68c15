// The words of a command line that name the inputs of a run, as a shell takes them back.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hopmesh::input {

/// A word in quotes where a shell would ask for them.
std::string shell_word(const std::string& word);

/// SCENE, --array and each --set.
struct InputWords {
  std::string scene, array;
  std::vector<std::string> overrides;
};

/// The words with an override of motion.steps; 0 steps: as they are.
InputWords with_steps(InputWords words, std::int64_t steps);
std::string text_of(const InputWords& words);

} // namespace hopmesh::input
