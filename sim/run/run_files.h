// The results folder of one run: arrays and table as the steps come, figures and pictures at the end.
#pragma once

#include "sim/files/csv.h"
#include "sim/files/grey_picture.h"
#include "sim/files/npy.h"
#include "sim/levels/level.h"
#include "sim/run/resume.h"
#include "sim/run/simulation.h"

namespace hopmesh::run {

/// What a run was, beside its steps: everything that manifest, statistics and report say of it.
struct RunFacts {
  scene::Inputs inputs;
  const levels::Level* level = nullptr; ///< never null
  std::string command;                  ///< that repeats the run, but for its --steps
  std::uint64_t asked_steps = 0;        ///< --steps; 0: as many as the scene says
  bool check = false;                   ///< the reference is asked
};

/// Totals of a run, as printed and as kept in stats.json.
struct Totals {
  std::uint64_t steps = 0, sweeps = 0, cycles = 0, bus_cycles = 0, updates = 0, clipped = 0, unconverged = 0;
  double worst_strain = 0, largest_error = 0, largest_network_error = 0, worst_energy_gap = 0;
  double median_error = 0, median_energy_gap = 0; ///< of the steps: rms error of outputs, energy left
  double peak_memory_mb = 0;
};
Totals totals_of(const RunResult& result, const levels::BuiltMesh& mesh);

/// Streams positions.npy, outputs_raw.npy and steps.csv; nothing has its final name before finish(). Holds
/// the folder against other runs.
class RunFiles : public StepSink {
 public:
  /// Makes the folder and makes sure, before any work, that the results can be written: throws
  /// record::WriteError.
  RunFiles(const std::filesystem::path& folder, const RunFacts& facts, const levels::BuiltMesh& mesh,
           const levels::Motion& motion);
  /// Goes on with what a killed or stopped run left there.
  RunFiles(const std::filesystem::path& folder, const RunFacts& facts, const levels::BuiltMesh& mesh,
           RunStreams streams);

  void step(const levels::StepRow& row, const levels::Motion& motion) override;
  /// All steps so far are on the disk; how far that is.
  std::vector<NamedMark> sync();
  /// Gives the streams their names and adds stats.json, manifest.json, mesh.glb, picture.svg, report.html
  /// and, where an image pulls, overlay.svg. A checkpoint stays only where there is something to go on with.
  void finish(const RunResult& result, const levels::Motion& motion);

  const std::filesystem::path& folder() const { return folder_; }
  const RunFacts& facts() const { return facts_; }
  const levels::BuiltMesh& mesh() const { return mesh_; }
  /// Of what comes from files: the mesh as built, the picture that pulls if there is one.
  std::uint64_t mesh_hash() const { return mesh_hash_; }
  std::optional<std::uint64_t> image_hash() const;

 private:
  void overlay(const levels::Motion& motion) const;
  void discard(const std::string& name) const;
  std::string statistics(const RunResult& result, const levels::Motion& motion) const;
  std::string manifest(const RunResult& result) const;

  std::vector<std::size_t> place_shape() const { return {mesh_.nodes(), 3}; }
  std::vector<std::size_t> code_shape() const { return {mesh_.nodes(), mesh_.components()}; }

  const std::filesystem::path folder_;
  const RunFacts facts_;
  const levels::BuiltMesh& mesh_;
  const std::uint64_t mesh_hash_;
  const std::optional<files::GreyPicture> image_;
  const files::FolderLock lock_;
  files::NpyWriter<double> positions_;
  std::optional<files::NpyWriter<std::int32_t>> outputs_;
  files::CsvWriter table_;
};

} // namespace hopmesh::run
