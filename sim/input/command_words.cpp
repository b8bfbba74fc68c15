#include "sim/input/command_words.h"

namespace hopmesh::input {

std::string shell_word(const std::string& word) {
  if (!word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                              "0123456789_-./=:,") == std::string::npos)
    return word;
  std::string quoted = "'";
  for (char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

InputWords with_steps(InputWords words, std::int64_t steps) {
  if (steps > 0) words.overrides.push_back("motion.steps=" + std::to_string(steps));
  return words;
}

std::string text_of(const InputWords& words) {
  std::string text = shell_word(words.scene);
  if (!words.array.empty()) text += " --array " + shell_word(words.array);
  for (const std::string& override : words.overrides) text += " --set " + shell_word(override);
  return text;
}

} // namespace hopmesh::input
