#include "place.h"
#include "sim/input/input_error.h"
#include "tests/campaigns/mutants/hunt.h"
#include "tests/campaigns/mutants/repairs.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

#include <algorithm>
#include <stdexcept>

namespace hopmesh::campaigns {

namespace {

namespace fs = std::filesystem;
using tests::content_of;

/// Most mutants of a scene or a network may work for days: after a few seconds they are asked to stop, and
/// killed where they do not.
const std::string patience = "timeout --preserve-status -s INT -k 90 6 ";
#ifdef __SANITIZE_ADDRESS__
const std::string limits;
#else
const std::string limits = "ulimit -v 6000000; ";
#endif

/// The one line that people are told, beside notes and what is safe; the rest must be nothing.
std::string line_told(const std::string& err) {
  std::string told;
  for (const std::string& line : tests::lines_of(err)) {
    if (line.rfind("hopmesh: note: ", 0) == 0 || line.rfind("checkpoint: ", 0) == 0) continue;
    if (!told.empty() || line.rfind("hopmesh: ", 0) != 0)
      throw std::logic_error("exit 2 with more than a line: " + err.substr(0, 400));
    told = line;
  }
  if (told.empty()) throw std::logic_error("exit 2 without a line");
  return told;
}

void expect_good_end(const tests::Finished& end) {
  const std::string told = end.err.substr(0, 400);
  if (end.exit_code == 2) throw input::InputError(line_told(end.err));
  if (end.exit_code != 0 && end.exit_code != 1 && end.exit_code != 130)
    throw std::logic_error("exit " + std::to_string(end.exit_code) + ", signal " +
                           std::to_string(end.signal) + ": " + told);
  for (const char* word : {"internal error", "AddressSanitizer", "runtime error: ", "ThreadSanitizer"})
    if (end.err.find(word) != std::string::npos) throw std::logic_error(told);
}

std::function<void(const fs::path&)> program(const std::string& line) {
  return [line](const fs::path& folder) {
    tests::Surroundings around;
    around.folder = folder, around.patience_seconds = 200;
    expect_good_end(tests::run_shell(limits + patience + HOPMESH_PROGRAM + ' ' + line, around));
  };
}

void run_well(const fs::path& folder, const std::string& line) {
  tests::Surroundings around;
  around.folder = folder, around.patience_seconds = 300;
  const tests::Finished end = tests::run_program(tests::words_of(line), around);
  if (end.exit_code != 0) throw std::runtime_error(line + ": " + end.err);
}

/// A verb over a file that a reader knows.
Reader verb_over(const std::vector<Reader>& readers, const std::string& name, const std::string& line) {
  Reader reader = reader_named(readers, name);
  reader.name = tests::words_of(line)[0] + " over " + name;
  reader.read = program(line);
  reader.leaves_traces = true;
  return reader;
}

// ---- what sweep, size and budget keep, as they keep it

const std::string map =
    "scene = \"two-nodes\"\nmethods = [\"engine\", \"velocity_verlet\"]\nsteps = 10\ntimes = [0.5]\n"
    "[axes]\n\"motion.time_step\" = [0.1, 0.2]\n\"mesh.mass\" = [1.0, 2.0]\n";
const std::string net = "banner --set mesh.grid.rows=2 --set mesh.grid.columns=3 --steps 3";

Reader kept(const fs::path& folder, const std::string& start, const std::string& line,
            void (*repair)(std::string&)) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string file = fs::relative(entry.path(), folder).string();
    if (entry.is_regular_file() && file.rfind(start, 0) == 0)
      return {tests::words_of(line)[0] + " over " + start,
              file,
              {content_of(entry.path())},
              folder,
              program(line),
              repair,
              true};
  }
  throw std::runtime_error("no " + start + " in " + folder.string());
}

std::vector<Reader> verbs_over_kept_files(const fs::path& made) {
  const std::string sweep = "sweep map.toml --out k -j 1", maps = "stability map.toml --out k -j 1";
  const std::string size = "size " + net + " --error 0.01 --out k -j 1",
                    budget = "budget " + net + " --out k";
  const fs::path swept = made / "swept", sized = made / "sized", budgeted = made / "budgeted";
  for (const fs::path& folder : {swept, sized, budgeted}) fs::create_directories(folder);
  tests::write_text(swept / "map.toml", map);
  run_well(swept, sweep), run_well(sized, size), run_well(budgeted, budget);
  std::vector<Reader> all{
      kept(swept, "k/points/1", sweep, repair_rows), kept(swept, "k/points/2", maps, repair_rows),
      kept(swept, "k/results", "chart k", nullptr),  kept(swept, "k/study.hash", sweep, nullptr),
      kept(sized, "k/trials/", size, repair_rows),   kept(budgeted, "k/truth-", budget, nullptr)};
  // What points are measured against is asked for again only where a point is missing.
  for (const char* start : {"k/truth-", "k/reference-", "k/sensitivity-"}) {
    all.push_back(kept(swept, start, sweep, repair_rows));
    all.back().read = [again = all.back().read](const fs::path& folder) {
      fs::remove(folder / "k/points/3.csv");
      again(folder);
    };
  }
  return all;
}

} // namespace

std::vector<Reader> all_programs(const fs::path& made) {
  const std::vector<Reader> readers = all_readers(made);
  const auto over = [&](const char* name, const std::string& line) { return verb_over(readers, name, line); };
  std::vector<Reader> all{over("scene", "run ./m.toml --steps 2 --out r"),
                          over("scene", "info ./m.toml --toml"),
                          over("scene", "compare ./m.toml --steps 1"),
                          over("scene", "network ./m.toml --step 1 --out r"),
                          over("array", "run two-nodes --array ./m.toml --steps 2 --out r"),
                          over("array", "info two-nodes --array ./m.toml"),
                          over("mesh", "run ./scene.toml --steps 2 --out r"),
                          over("png", "run ./scene.toml --steps 2 --out r"),
                          over("pgm", "info ./scene.toml"),
                          over("matrix", "solve ./m.mtx --out r"),
                          over("scene", "solvers ./m.toml --step 1 --out r"),
                          over("bias", "solve ./W.mtx ./m.mtx --out r"),
                          over("vectors", "vectors --check m.txt"),
                          over("vectors", "fuzz --replay m.txt"),
                          over("checkpoint", "run --resume . --steps 20"),
                          over("steps of a killed run", "run --resume . --steps 20"),
                          over("positions of a killed run", "run --resume . --steps 20"),
                          over("manifest", "run --resume .")};
  Reader study = over("study", "sweep ./m.toml --out r -j 1");
  study.seeds = {map};
  all.push_back(std::move(study));
  for (Reader& reader : verbs_over_kept_files(made)) all.push_back(std::move(reader));
  return all;
}

} // namespace hopmesh::campaigns
