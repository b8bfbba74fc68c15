// The program: verbs, and the one place where errors become a line and an exit code.
#include "sim/cli/help.h"
#include "sim/cli/options.h"
#include "sim/cli/usage.h"
#include "sim/cli/verbs.h"
#include "sim/run/write_error.h"
#include "version.h"

#include <cstdlib>
#include <fmt/format.h>
#include <systemc>

using namespace hopmesh;

namespace {

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

int program(int argc, char** argv) {
  int exit_code = cli::done;
  CLI::App app(
      "A bit-accurate, cycle-level emulator of a neural-network machine that moves deformable meshes.",
      "hopmesh");
  app.set_version_flag(
      "--version",
      fmt::format("hopmesh {} ({}, {}, {})", run::version, run::commit, run::build_type, run::compiler),
      "version, commit and compiler");
  app.set_help_flag("-h,--help", "this text");
  app.formatter(std::make_shared<cli::HelpText>());
  app.footer(
      "Example:\n  hopmesh run flag-400 --out out/flag-400\n`hopmesh help VERB` tells more of a verb.");
  cli::add_verbs(app, exit_code);
  try {
    app.parse(cli::plain_words(app, {argv + 1, argv + argc}));
    if (app.get_subcommands().empty()) fmt::print("{}", app.help());
    return exit_code;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e); // --help, --version
    fmt::print(stderr, "hopmesh: {} (`hopmesh help` tells the usage)\n",
               one_line(cli::usage_sentence(app, e)));
  } catch (const input::InputError& e) {
    fmt::print(stderr, "hopmesh: {}\n", one_line(e.what()));
  } catch (const run::WriteError& e) {
    fmt::print(stderr, "hopmesh: {}\n", one_line(e.what()));
  }
  return cli::bad_input;
}

// Anything else is a defect of ours: told in a line as well, and never taken for bad input.
int guarded(int argc, char** argv) {
  try {
    return program(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "hopmesh: internal error: {}\n", one_line(e.what()));
    return cli::differs;
  }
}

} // namespace

int sc_main(int argc, char** argv) {
  return guarded(argc, argv);
}

int main(int argc, char** argv) {
  setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
  return sc_core::sc_elab_and_sim(argc, argv);
}
