// The help as people read it: verbs and flags in groups, defaults in words, lines that fit a terminal.
#pragma once

#include <CLI/CLI.hpp>

namespace hopmesh::cli {

class HelpText : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_usage(const CLI::App* app, std::string name) const override;
  std::string make_subcommand(const CLI::App* verb) const override;
  std::string make_option(const CLI::Option* option, bool positional) const override;
};

/// The words of a command line as the library wants them, last first; `help VERB` means `VERB --help`.
std::vector<std::string> plain_words(const CLI::App& program, std::vector<std::string> words);

} // namespace hopmesh::cli
