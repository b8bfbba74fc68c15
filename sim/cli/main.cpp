// The program: verbs, and the one place where errors become a line and an exit code.
#include "sim/cli/options.h"
#include "sim/record/output_file.h"
#include "study_version.h"

#include <cstdlib>
#include <fmt/format.h>

using namespace hopmesh;

namespace {

// A word where a verb should stand is the commonest mistake: say which verb is near.
std::string usage_error(const CLI::App& program, int argc, char** argv, const std::string& what) {
  std::vector<std::string> verbs;
  for (const CLI::App* verb : program.get_subcommands([](const CLI::App*) { return true; }))
    verbs.push_back(verb->get_name());
  const std::string word = argc > 1 ? argv[1] : "";
  if (word.empty() || word[0] == '-' || std::find(verbs.begin(), verbs.end(), word) != verbs.end())
    return what;
  return scene::input_error("", 0, "verb", word, fmt::format("{}", fmt::join(verbs, ", ")),
                            scene::nearest_name(word, verbs))
      .what();
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
  app.set_version_flag("--version", fmt::format("hopmesh {} ({}, {}, {})", study::version, study::commit,
                                                study::build_type, study::compiler));
  app.require_subcommand(1);
  app.footer(
      "Example:\n  hopmesh run flag-400 --out out/flag-400\nhopmesh VERB --help tells more of a verb.");
  cli::add_run(app, exit_code);
  cli::add_compare(app, exit_code);
  cli::add_network(app, exit_code);
  cli::add_info(app, exit_code);
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e); // --help, --version
    fmt::print(stderr, "hopmesh: {} (hopmesh --help tells the usage)\n",
               one_line(usage_error(app, argc, argv, e.what())));
  } catch (const scene::InputError& e) {
    fmt::print(stderr, "hopmesh: {}\n", one_line(e.what()));
  } catch (const record::WriteError& e) {
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
