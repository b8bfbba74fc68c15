#include "sim/levels/prepared.h"
#include "sim/study/kept_positions.h"
#include "sim/study/result_chart.h"
#include "sim/study/sensitivity_store.h"
#include "sim/study/size/trial_folder.h"
#include "sim/study/stability_map.h"
#include "sim/study/study_folder.h"
#include "tests/campaigns/mutants/reader.h"
#include "tests/campaigns/mutants/repairs.h"
#include "tests/support/files.h"

#include <stdexcept>

namespace hopmesh::campaigns {

namespace {

namespace fs = std::filesystem;
using tests::content_of;

// ---- a study's folder

const std::string map_text = "scene = \"two-nodes\"\nsteps = 10\ntimes = [0.5, 1]\n[axes]\n"
                             "\"motion.time_step\" = [0.1, 0.2]\n\"mesh.mass\" = [1.0, 2.0]\n";
constexpr std::uint64_t map_hash = 0x0123456789abcdef;

const study::Study& map() {
  static const study::Study read = study::study_of(map_text, "map.toml");
  return read;
}

study::PointRow row_of(std::size_t number) {
  study::PointRow row;
  const auto x = static_cast<double>(number);
  row.outcome = number == 2 ? run::Outcome::diverged : run::Outcome::finished;
  row.stability = number == 2 ? study::Stability::blow_up : study::Stability::stable;
  row.steps = 10, row.sweeps = 40 + number, row.cycles = 4000, row.bus_cycles = 900, row.memory_bits = 1024;
  row.array_seconds = 1e-5, row.host_seconds = 0.002, row.largest_strain = 0.25 * x, row.omega = 1.5;
  row.output_error = 1e-4 * x, row.position_error = 2e-5, row.hardware_seconds = 1e-5 + x;
  row.reference_at = {1e-5, 2e-5}, row.truth_at = {0.01, std::nullopt}, row.floor_at = {1e-9, 1e-9};
  row.sensitivity_at = {1e-12, 1e-11};
  row.sentence = "All 10 steps done, \"really\"";
  return row;
}

/// The folder of the study with all its points, and its results collected.
fs::path study_folder(const fs::path& folder) {
  const study::StudyFolder into(map(), folder, map_hash, false);
  for (std::size_t n : into.missing()) into.save(study::point_of(map(), n), row_of(n));
  into.collect();
  return folder;
}

void read_points(const fs::path& folder) {
  const study::StudyFolder found(map(), folder, map_hash, false);
  if (found.missing().empty()) found.collect(), study::draw_map(folder, map());
}

// Every second one with an axis as the spread of its marks.
void read_results(const fs::path& folder) {
  study::ChartOrder order;
  order.folder = folder;
  if (fs::file_size(folder / "results.csv") % 2) order.over = {"mesh.mass"};
  study::draw_chart(order);
}

// ---- positions that points are measured against

const std::vector<double> times{0.5, 1};

levels::ExactMotion positions_of_two() {
  return {{{0, 0, 0, 1, 0.25, -1e-9}, {0, 0.5, 0, 1, 0.125, 1e300}}, {1e-9, 2e-9}};
}

fs::path positions_folder(const fs::path& folder) {
  fs::create_directories(folder);
  study::kept_positions(folder / "truth", times, 2, positions_of_two);
  return folder;
}

void read_positions(const fs::path& folder) {
  study::kept_positions(folder / "truth", times, 2, []() -> levels::ExactMotion {
    throw std::logic_error("a file that is there was worked out anew");
  });
}

const levels::Prepared& two_nodes() {
  static const levels::Prepared prepared = levels::prepare("two-nodes", "", {"motion.steps=3"});
  return prepared;
}

void read_sensitivity(const fs::path& folder) {
  study::SensitivityStore(folder).at(two_nodes().inputs, *two_nodes().mesh, times);
}

fs::path sensitivity_folder(const fs::path& folder) {
  fs::create_directories(folder);
  read_sensitivity(folder);
  return folder;
}

// ---- trials of a search

const study::Setting setting{8, 9, 10};

void read_trials(const fs::path& folder) {
  study::TrialFolder(folder, map_hash).find(setting);
}

fs::path trials_folder(const fs::path& folder) {
  const study::TrialFolder into(folder, map_hash);
  study::TrialRow row;
  row.outcome = run::Outcome::finished, row.error = 0.001, row.sweeps = 50, row.most_sweeps = 9;
  row.cycles = 1000, row.bus_cycles = 20, row.most_cycles = 200;
  into.save(setting, row);
  return folder;
}

/// A reader of one file of a folder, the file itself being its seed.
Reader reader_in(const std::string& name, const fs::path& folder, const std::string& file,
                 std::function<void(const fs::path&)> read, void (*repair)(std::string&) = nullptr) {
  return {name, file, {content_of(folder / file)}, folder, std::move(read), repair, true};
}

} // namespace

std::vector<Reader> readers_of_kept_files(const fs::path& made) {
  const fs::path points = study_folder(made / "points"), positions = positions_folder(made / "positions");
  const fs::path trials = trials_folder(made / "trials"), floor = sensitivity_folder(made / "sensitivity");
  std::vector<Reader> all{
      reader_in("point", points, "points/2.csv", read_points, repair_rows),
      reader_in("mark of a study", points, "study.hash", read_points),
      reader_in("results", points, "results.csv", read_results),
      reader_in("study beside results", points, "study.toml", read_results),
      reader_in("positions", positions, "truth.csv", read_positions, repair_rows),
      reader_in("values of positions", positions, "truth.npy", read_positions),
      reader_in("sensitivity", floor, tests::names_in(floor).at(0), read_sensitivity, repair_rows),
      reader_in("trial", trials, "trials/" + tests::names_in(trials / "trials").at(0), read_trials,
                repair_rows),
      reader_in("mark of a search", trials, "size.hash", read_trials)};
  for (std::size_t other : {0, 1, 3})
    all[0].seeds.push_back(content_of(points / "points" / (std::to_string(other) + ".csv")));
  return all;
}

} // namespace hopmesh::campaigns
