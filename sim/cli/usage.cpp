#include "sim/cli/usage.h"

#include "sim/input/input_error.h"

#include <fmt/format.h>
#include <regex>

namespace hopmesh::cli {

namespace {

std::string sentence(const std::string& what, const std::string& found, const std::string& expected,
                     const std::string& nearest = "") {
  return input::input_error("", 0, what, found, expected, nearest).what();
}

std::string not_one_of(const std::string& what, const std::string& word,
                       const std::vector<std::string>& names) {
  return sentence(what, word, fmt::format("{}", fmt::join(names, ", ")), input::nearest_name(word, names));
}

const CLI::App& verb_in(const CLI::App& program) {
  for (const CLI::App* verb : program.get_subcommands([](const CLI::App*) { return true; }))
    if (verb->parsed()) return *verb;
  return program;
}

std::vector<std::string> flags_of(const CLI::App& app) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
  return flags;
}

std::string description_of(const CLI::App& verb, const std::string& name) {
  const CLI::Option* option = verb.get_option_no_throw(name);
  return option ? option->get_description() : "a value";
}

// A mistyped verb or flag is the commonest mistake: say which one is near. Empty where no word is left over.
std::string about_words_left(const CLI::App& program, const CLI::App& verb) {
  const std::vector<std::string> left = program.remaining(true);
  for (const std::string& word : left)
    if (word.size() > 1 && word[0] == '-')
      return not_one_of("flag", word.substr(0, word.find('=')), flags_of(verb));
  if (left.empty()) return "";
  if (&verb == &program) return not_one_of("verb", left[0], verb_names(program));
  return sentence(verb.get_name(), fmt::format("\"{}\" as well", left[0]), "no more words");
}

/// What the command-line library says, in its words, and in ours: {0} the flag, {1} what else it names, {2}
/// the flag's description.
struct Translation {
  const char* theirs;
  const char *found, *expected;
};
const Translation translations[] = {
    {"(\\S+) is required()", "nothing", "{2}"},
    {"(\\S+): \\d+ required \\w+ missing()", "no value", "{2}"},
    {"(\\S+): (?:.*) required .*missing()", "no value", "{2}"},
    {"(\\S+) excludes (\\S+)", "{1} beside it", "one of the two"},
    {"(\\S+) requires (\\S+)", "no {1}", "{1} beside it"},
    {"Could not convert: (\\S+) = (.*)", "{1}", "{2}"},
    {"(\\S+): At Most (?:.*)()", "several times", "once"},
    {"(\\S+): Expected (?:.*)()", "a wrong number of values", "{2}"},
};

} // namespace

std::vector<std::string> verb_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* verb : program.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(verb->get_name());
  return names;
}

std::string usage_sentence(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& verb = verb_in(program);
  std::string left = about_words_left(program, verb);
  if (!left.empty()) return left;
  std::string theirs = error.what();
  std::smatch part;
  for (const Translation& t : translations)
    if (std::regex_match(theirs, part, std::regex(t.theirs))) {
      const std::string flag = part[1], other = part[2], words = description_of(verb, flag);
      return sentence(flag, fmt::format(fmt::runtime(t.found), flag, other, words),
                      fmt::format(fmt::runtime(t.expected), flag, other, words));
    }
  return theirs; // a check of ours has said it already
}

} // namespace hopmesh::cli
