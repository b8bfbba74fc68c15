#include "sim/cli/verbs.h"

#include "sim/cli/checks.h"

namespace hopmesh::cli {

using AddVerb = void(CLI::App& program, int& exit_code);
AddVerb add_run, add_compare;
AddVerb add_info, add_vectors, add_fuzz, add_rtl, add_cost;
AddVerb add_sweep, add_chart, add_stability, add_budget, add_size;
AddVerb add_network, add_solve, add_problem, add_solvers;
AddVerb add_scenes, add_presets, add_levels, add_studies, add_problems, add_help;

namespace {

struct Verb {
  AddVerb* add;
  const char* group;
};

constexpr Verb verbs[] = {
    {add_run, "Motions"},          {add_compare, "Motions"},       {add_info, "Arrays"},
    {add_vectors, "Arrays"},       {add_fuzz, "Arrays"},           {add_rtl, "Arrays"},
    {add_cost, "Arrays"},          {add_sweep, "Studies"},         {add_chart, "Studies"},
    {add_stability, "Studies"},    {add_budget, "Studies"},        {add_size, "Studies"},
    {add_network, "Networks"},     {add_solve, "Networks"},        {add_problem, "Networks"},
    {add_solvers, "Networks"},     {add_scenes, "What there is"},  {add_presets, "What there is"},
    {add_levels, "What there is"}, {add_studies, "What there is"}, {add_problems, "What there is"},
    {add_help, "What there is"},
};

} // namespace

void add_verbs(CLI::App& program, int& exit_code) {
  for (const Verb& verb : verbs) {
    verb.add(program, exit_code);
    CLI::App* added = program.get_subcommands([](const CLI::App*) { return true; }).back();
    added->group(verb.group);
    check_values(*added);
  }
}

} // namespace hopmesh::cli
