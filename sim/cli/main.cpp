// The program: verbs, and the one place where errors become a line and an exit code.
#include "sim/cli/help.h"
#include "sim/cli/options.h"
#include "sim/cli/usage.h"
#include "sim/cli/verbs.h"
#include "sim/input/standard_streams.h"
#include "sim/run/children.h"
#include "sim/run/write_error.h"
#include "version.h"

#include <cstdlib>
#include <fmt/format.h>
#include <new>
#include <system_error>
#include <systemc>

using namespace hopmesh;

namespace {

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

/// A line on stderr, and the exit code of what cannot be done.
int told(const std::string& line) {
  input::say("hopmesh: " + one_line(line) + '\n');
  return cli::bad_input;
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
    return told(cli::usage_sentence(app, e) + " (`hopmesh help` tells the usage)");
  }
}

/// The program, and what it printed has arrived.
int whole_program(int argc, char** argv) {
  const int exit_code = program(argc, argv);
  input::finish_stdout();
  return exit_code;
}

/// What the system refuses (a process, a thread, a folder, a place for what is printed) is no defect of ours.
int told_refusal(const std::system_error& e) {
  return told(input::stdout_failed() ? "stdout: " + e.code().message() : e.what());
}

// What is left in the end is a defect: told in a line as well, and never taken for bad input.
int guarded(int argc, char** argv) {
  try {
    return whole_program(argc, argv);
  } catch (const input::InputError& e) {
    return told(e.what());
  } catch (const run::WriteError& e) {
    return told(e.what());
  } catch (const run::Refused& e) {
    return told(e.what());
  } catch (const std::bad_alloc&) {
    return told("memory: found less than this takes, expected a smaller mesh, fewer at a time (-j), or a "
                "higher limit (ulimit -v)");
  } catch (const std::system_error& e) {
    return told_refusal(e);
  } catch (const std::exception& e) {
    told(fmt::format("internal error: {}", e.what()));
    return cli::differs;
  }
}

} // namespace

int sc_main(int argc, char** argv) {
  return guarded(argc, argv);
}

int main(int argc, char** argv) {
  input::open_standard_streams();
  setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
  return sc_core::sc_elab_and_sim(argc, argv);
}
