// hopmesh scenes, presets, levels, studies, problems: what comes with the program, a line each.
#include "sim/cli/options.h"
#include "sim/input/presets.h"
#include "sim/input/shipped.h"
#include "sim/levels/level.h"
#include "sim/networks/problems/problem.h"

#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

void print_line(const std::string& name, const std::string& words) {
  fmt::print("{:<24}{}\n", name, words);
}

void print_shipped(input::Shipped kind) {
  for (const std::string& name : input::shipped_names(kind))
    print_line(name, input::about_shipped(name, kind));
}

std::string with_default(const std::string& name, bool is_default) {
  return name + (is_default ? " (default)" : "");
}

void print_presets() {
  for (const input::PresetWords& preset : input::preset_words())
    print_line(with_default(preset.name, preset.is_default), preset.words);
}

void print_levels() {
  for (const levels::Level& level : levels::levels())
    print_line(with_default(level.name, level.name == levels::default_level().name), level.words);
}

void print_problems() {
  for (const std::string& name : problems::names()) print_line(name, problems::about(name));
}

void add_list(CLI::App& program, int& exit_code, const std::string& name, const char* words,
              const std::function<void()>& print) {
  CLI::App* verb = program.add_subcommand(name, words);
  verb->footer("Example:\n  hopmesh " + name);
  verb->callback([print, &exit_code] {
    print();
    exit_code = done;
  });
}

} // namespace

void add_scenes(CLI::App& program, int& exit_code) {
  add_list(program, exit_code, "scenes", "the scenes that come with the program",
           [] { print_shipped(input::Shipped::scene); });
}

void add_presets(CLI::App& program, int& exit_code) {
  add_list(program, exit_code, "presets", "the arrays that have a name", print_presets);
}

void add_levels(CLI::App& program, int& exit_code) {
  add_list(program, exit_code, "levels", "what can fly a scene: the array in several forms, and its rivals",
           print_levels);
}

void add_studies(CLI::App& program, int& exit_code) {
  add_list(program, exit_code, "studies", "the studies that come with the program",
           [] { print_shipped(input::Shipped::study); });
}

void add_problems(CLI::App& program, int& exit_code) {
  add_list(program, exit_code, "problems", "the networks that `solve` and `problem` know by name",
           print_problems);
}

} // namespace hopmesh::cli
