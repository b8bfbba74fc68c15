// The program: verbs, and the one place where errors become a line and an exit code.
#include "sim/cli/options.h"
#include "sim/files/output_file.h"
#include "version.h"

#include <cstdlib>
#include <fmt/format.h>
#include <systemc>

using namespace hopmesh;

namespace {

std::vector<std::string> flags_of(const CLI::App& app) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
  return flags;
}

std::string not_one_of(const std::string& what, const std::string& word,
                       const std::vector<std::string>& names) {
  return input::input_error("", 0, what, word, fmt::format("{}", fmt::join(names, ", ")),
                            input::nearest_name(word, names))
      .what();
}

// A mistyped verb or flag is the commonest mistake: say which one is near.
std::string usage_error(const CLI::App& program, const std::string& what) {
  std::vector<std::string> verbs;
  const CLI::App* place = &program;
  for (const CLI::App* verb : program.get_subcommands([](const CLI::App*) { return true; })) {
    verbs.push_back(verb->get_name());
    if (verb->parsed()) place = verb;
  }
  const std::vector<std::string> left = program.remaining(true);
  for (const std::string& word : left)
    if (word.size() > 1 && word[0] == '-')
      return not_one_of("flag", word.substr(0, word.find('=')), flags_of(*place));
  return place == &program && !left.empty() ? not_one_of("verb", left[0], verbs) : what;
}

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
  app.set_version_flag("--version", fmt::format("hopmesh {} ({}, {}, {})", run::version, run::commit,
                                                run::build_type, run::compiler));
  app.require_subcommand(1);
  app.footer(
      "Example:\n  hopmesh run flag-400 --out out/flag-400\nhopmesh VERB --help tells more of a verb.");
  cli::add_run(app, exit_code);
  cli::add_compare(app, exit_code);
  cli::add_network(app, exit_code);
  cli::add_solvers(app, exit_code);
  cli::add_info(app, exit_code);
  cli::add_vectors(app, exit_code);
  cli::add_fuzz(app, exit_code);
  cli::add_sweep(app, exit_code);
  cli::add_chart(app, exit_code);
  cli::add_stability(app, exit_code);
  cli::add_solve(app, exit_code);
  cli::add_problem(app, exit_code);
  cli::add_budget(app, exit_code);
  cli::add_size(app, exit_code);
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e); // --help, --version
    fmt::print(stderr, "hopmesh: {} (hopmesh --help tells the usage)\n",
               one_line(usage_error(app, e.what())));
  } catch (const input::InputError& e) {
    fmt::print(stderr, "hopmesh: {}\n", one_line(e.what()));
  } catch (const files::WriteError& e) {
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
