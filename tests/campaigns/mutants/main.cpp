// The campaigns of broken files: mutants by the million in the readers, by the thousand in whole processes.
#include "sim/levels/interrupt.h"
#include "sim/run/progress.h"
#include "tests/campaigns/mutants/hunt.h"
#include "tests/support/files.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <systemc>

using namespace hopmesh;
using namespace hopmesh::campaigns;

namespace {

struct Wanted {
  Hunt plan;
  bool processes = false, list = false;
  std::vector<std::string> names;
  std::string out = "out/mutants";
};

/// Those that were named, or all.
std::vector<Reader> chosen(const std::vector<Reader>& all, const std::vector<std::string>& names) {
  if (names.empty()) return all;
  std::vector<Reader> some;
  for (const std::string& name : names) some.push_back(reader_named(all, name));
  return some;
}

void tell(const std::vector<Reader>& readers, const Hunted& found, double seconds) {
  Tally all;
  std::printf("%-32s %10s %10s %8s\n", "reader", "read", "refused", "faults");
  for (std::size_t r = 0; r < readers.size(); ++r) {
    const Tally& of = found.of[r];
    std::printf("%-32s %10lu %10lu %8lu\n", readers[r].name.c_str(), of.read, of.refused, of.faults);
    all.read += of.read, all.refused += of.refused, all.faults += of.faults;
  }
  std::printf("%-32s %10lu %10lu %8lu\n", "all", all.read, all.refused, all.faults);
  std::printf("%lu mutants in %.0f s\n", all.read + all.refused + all.faults, seconds);
  for (const std::string& fault : found.faults) std::printf("%s\n", fault.c_str());
  if (found.interrupted) std::printf("interrupted; to go on: --first %lu\n", found.next);
}

int search(Wanted wanted) {
  levels::catch_interrupts();
  const tests::Folder made;
  const std::vector<Reader> readers =
      chosen(wanted.processes ? all_programs(made.path()) : all_readers(made.path()), wanted.names);
  if (wanted.list) {
    for (const Reader& reader : readers) std::printf("%s\n", reader.name.c_str());
    return 0;
  }
  wanted.plan.out = wanted.out;
  const auto began = std::chrono::steady_clock::now();
  Hunted found;
  {
    run::CountProgress progress("mutants", wanted.plan.mutants * readers.size());
    found = hunt(
        readers, wanted.plan, [&](std::uint64_t done) { progress.count(done); }, levels::stop_requested);
  }
  tell(readers, found, std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  std::uint64_t faults = 0;
  for (const Tally& of : found.of) faults += of.faults;
  return faults > 0 ? 1 : found.interrupted ? 130 : 0;
}

} // namespace

int sc_main(int argc, char** argv) {
  Wanted w;
  CLI::App app(
      "Broken files for everything that reads one: each mutant must be read, or refused in a sentence.",
      "mutants");
  app.add_flag("--processes", w.processes, "whole processes of the program, in place of its readers");
  app.add_flag("--list", w.list, "the names of the readers");
  app.add_option("--reader", w.names, "only these; all where none is named");
  app.add_option("--mutants", w.plan.mutants, "of each reader")->capture_default_str();
  app.add_option("--seed", w.plan.seed, "seed, reader and number make a mutant")->capture_default_str();
  app.add_option("--first", w.plan.first, "the first number")->capture_default_str();
  app.add_option("--batch", w.plan.batch, "mutants of a child")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--seconds", w.plan.seconds, "a mutant that takes longer hangs")->capture_default_str();
  app.add_option("-j", w.plan.children, "children at once")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--out", w.out, "a folder for what is found")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return search(w);
}

int main(int argc, char** argv) {
  setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
  return sc_core::sc_elab_and_sim(argc, argv);
}
