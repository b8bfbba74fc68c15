// hopmesh scenes, presets, studies, problems: what comes with the program, a line each.
#include "rtl_model/spec/array_rules.h"
#include "sim/cli/options.h"
#include "sim/input/shipped.h"
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

void print_presets() {
  for (const spec::ArraySpec& array : spec::presets())
    print_line(array.name + (array.name == spec::default_array().name ? " (default)" : ""),
               fmt::format("{}, {}, {} lane{}, states of {} bits, links of {}", spec::name_of(array.schedule),
                           spec::name_of(array.normaliser), array.lanes, array.lanes == 1 ? "" : "s",
                           array.formats.state.width, array.formats.link.width));
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

void add_studies(CLI::App& program, int& exit_code) {
  add_list(program, exit_code, "studies", "the studies that come with the program",
           [] { print_shipped(input::Shipped::study); });
}

void add_problems(CLI::App& program, int& exit_code) {
  add_list(program, exit_code, "problems", "the networks that `solve` and `problem` know by name",
           print_problems);
}

} // namespace hopmesh::cli
