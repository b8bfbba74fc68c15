// A study's results folder: a safe file for each finished point, and results.csv made of them in the end.
#pragma once

#include "sim/study/safe_folder.h"
#include "sim/study/study_points.h"

namespace hopmesh::study {

class StudyFolder {
 public:
  /// Takes up what is there. Throws InputError if it belongs to another study, or to this one before it was
  /// changed (`hash`, of check_points); DamagedFile for points that are not as they were written. `alone`:
  /// lock the folder against other writers.
  StudyFolder(const Study& study, const std::filesystem::path& folder, std::uint64_t hash, bool alone);

  bool has(std::size_t number) const { return safe_.has(std::to_string(number)); }
  /// Numbers of the points still to run.
  std::vector<std::size_t> missing() const;
  /// Safe from any kill once this returns.
  void save(const Point& point, const PointRow& row) const;
  /// results.csv in the points' order, once all are there; says how many of each status.
  std::map<std::string, std::size_t> collect() const;
  const std::filesystem::path& path() const { return safe_.path(); }

 private:
  files::CsvTable row(std::size_t number) const;

  const Study& study_;
  const SafeFolder safe_;
};

} // namespace hopmesh::study
