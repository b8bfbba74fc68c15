#include "sim/cli/help.h"

#include "sim/cli/options.h"
#include "sim/cli/usage.h"

#include <algorithm>
#include <fmt/format.h>
#include <sstream>

namespace hopmesh::cli {

namespace {

constexpr std::size_t name_columns = 26, line_columns = 100;

/// Behind a name of its own width, the words in lines that begin below one another.
std::string entry(const std::string& name, const std::string& words) {
  std::string text = fmt::format("  {:<{}}", name, name_columns - 2);
  std::size_t column = text.size();
  if (column > name_columns) text += '\n' + std::string(name_columns, ' '), column = name_columns;
  std::istringstream in(words);
  for (std::string word; in >> word; column += word.size() + 1) {
    if (column > name_columns && column + word.size() > line_columns) {
      text.back() = '\n';
      text += std::string(name_columns, ' ');
      column = name_columns;
    }
    text += word + ' ';
  }
  text.pop_back();
  return text + '\n';
}

std::string value_of(const CLI::Option* option) {
  if (option->get_type_size() == 0) return "";
  const std::string type = option->get_type_name();
  const bool whole = type.find("INT") == 0, number = type.find("FLOAT") == 0;
  const bool several = option->get_delimiter() != '\0';
  return std::string(" ") +
         (whole            ? "N"
          : number         ? "X"
          : type == "TEXT" ? "TEXT"
                           : type) +
         (several ? ",..." : "");
}

std::string words_of(const CLI::Option* option) {
  std::string words = option->get_description();
  if (option->get_required()) words += " (required)";
  if (!option->get_default_str().empty() && option->get_default_str() != "0")
    words += fmt::format(" (default {})", option->get_default_str());
  return words;
}

} // namespace

// The library leaves two blank lines between groups.
std::string HelpText::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
  for (std::size_t at; (at = text.find("\n\n\n")) != std::string::npos;) text.erase(at, 1);
  return text;
}

std::string HelpText::make_usage(const CLI::App* app, std::string name) const {
  if (app->get_parent() == nullptr) return fmt::format("Usage: {} VERB ...\n", name);
  std::string usage = "Usage: " + name;
  for (const CLI::Option* option : app->get_options())
    if (option->get_positional())
      usage += fmt::format(option->get_required() ? " {}" : " [{}]", option->get_name(true));
  return usage + " [flags]\n";
}

std::string HelpText::make_subcommand(const CLI::App* verb) const {
  return entry(verb->get_name(), verb->get_description());
}

std::string HelpText::make_option(const CLI::Option* option, bool positional) const {
  const std::string name = option->get_name(positional, !positional);
  return entry(name + (positional ? "" : value_of(option)), words_of(option));
}

namespace {

bool has_verb(const CLI::App& program, const std::string& name) {
  const std::vector<std::string> names = verb_names(program);
  return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

std::vector<std::string> plain_words(const CLI::App& program, std::vector<std::string> words) {
  if (words.size() == 2 && words[0] == "help" && has_verb(program, words[1])) words = {words[1], "--help"};
  std::reverse(words.begin(), words.end()); // the library takes them off the end
  return words;
}

void add_help(CLI::App& program, int& exit_code) {
  auto name = std::make_shared<std::string>();
  CLI::App* verb = program.add_subcommand("help", "this text, or that of a verb");
  verb->add_option("VERB", *name, "one of the verbs");
  verb->footer("Example:\n  hopmesh help run");
  verb->callback([&program, name, &exit_code] {
    if (!name->empty()) check_name(*name, "help", verb_names(program));
    fmt::print("{}",
               program.get_formatter()->make_help(&program, program.get_name(), CLI::AppFormatMode::Normal));
    exit_code = done;
  });
}

} // namespace hopmesh::cli
