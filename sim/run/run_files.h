// The results folder of one run: arrays and table as the steps come, figures and pictures at the end.
#pragma once

#include "sim/files/csv.h"
#include "sim/files/grey_picture.h"
#include "sim/files/npy.h"
#include "sim/run/resume.h"
#include "sim/run/run_facts.h"
#include "sim/run/simulation.h"

namespace hopmesh::run {

/// Streams positions.npy, outputs_raw.npy and steps.csv; nothing has its final name before finish(). Holds
/// the folder against other runs.
class RunFiles : public StepSink {
 public:
  /// Makes the folder and makes sure, before any work, that the results can be written: throws
  /// record::WriteError.
  RunFiles(const std::filesystem::path& folder, const RunFacts& facts, const levels::BuiltMesh& mesh,
           const levels::Mover& motion);
  /// Goes on with what a killed or stopped run left there.
  RunFiles(const std::filesystem::path& folder, const RunFacts& facts, const levels::BuiltMesh& mesh,
           RunStreams streams);

  void step(const levels::StepRow& row, const levels::Mover& motion) override;
  /// All steps so far are on the disk; how far that is.
  std::vector<NamedMark> sync();
  /// Gives the streams their names and adds stats.json, manifest.json, mesh.glb, picture.svg, report.html
  /// and, where an image pulls, overlay.svg. A checkpoint stays only where there is something to go on with.
  void finish(const RunResult& result, const levels::Mover& motion);

  const std::filesystem::path& folder() const { return folder_; }
  const RunFacts& facts() const { return facts_; }
  const levels::BuiltMesh& mesh() const { return mesh_; }
  /// Of what comes from files: the mesh as built, the picture that pulls if there is one.
  std::uint64_t mesh_hash() const { return mesh_hash_; }
  std::optional<std::uint64_t> image_hash() const;

 private:
  void overlay(const levels::Mover& motion) const;
  void discard(const std::string& name) const;
  std::string statistics(const RunResult& result, const levels::Mover& motion) const;
  std::string write_manifest(const RunResult& result) const;
  /// But for the hashes of the steps, and the end.
  std::string manifest_head(const RunResult& result) const;

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
