// The results folder of one run: arrays and table as the steps come, figures and pictures at the end.
#pragma once

#include "sim/record/csv.h"
#include "sim/record/npy.h"
#include "sim/scene/scene_file.h"
#include "sim/study/simulation.h"

#include <filesystem>

namespace hopmesh::study {

/// What a run was, beside its steps: everything that manifest, statistics and report say of it.
struct RunFacts {
  scene::Inputs inputs;
  std::string level;
  bool fixed = false;  ///< a level with raw codes and cycles
  std::string command; ///< that repeats the run
};

/// Totals of a run, as printed and as kept in stats.json.
struct Totals {
  std::uint64_t steps = 0, sweeps = 0, cycles = 0, bus_cycles = 0, updates = 0, clipped = 0, unconverged = 0;
  double worst_strain = 0, largest_error = 0, largest_network_error = 0, worst_energy_gap = 0;
  double median_error = 0, median_energy_gap = 0; ///< of the steps: rms error of outputs, energy left
  double peak_memory_mb = 0;
};
Totals totals_of(const RunResult& result, const BuiltMesh& mesh);

/// Streams positions.npy, outputs_raw.npy and steps.csv; nothing has its final name before finish().
class RunFiles : public StepSink {
 public:
  /// Makes the folder and makes sure, before any work, that the results can be written: throws
  /// record::WriteError.
  RunFiles(const std::filesystem::path& folder, const RunFacts& facts, const BuiltMesh& mesh,
           const Motion& motion);

  void step(const StepRow& row, const Motion& motion) override;
  /// Gives the streams their names and adds stats.json, manifest.json, mesh.glb and report.html.
  void finish(const RunResult& result, const Motion& motion);

 private:
  std::string statistics(const RunResult& result, const Motion& motion) const;
  std::string manifest(const RunResult& result) const;

  const std::filesystem::path folder_;
  const RunFacts facts_;
  const BuiltMesh& mesh_;
  record::NpyWriter<double> positions_;
  std::optional<record::NpyWriter<std::int32_t>> outputs_;
  record::CsvWriter table_;
};

} // namespace hopmesh::study
