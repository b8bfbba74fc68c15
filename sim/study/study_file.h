// A study: a scene and an array, and axes along which their keys vary (docs/use/study-files.md).
#pragma once

#include "sim/input/input_error.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hopmesh::study {

/// An override of scene or array, and the line of the study that asks for it.
struct StudySetting {
  std::string key, text; ///< text: a TOML value
  int line = 0;
};

/// A place on an axis: what it is called, and the keys that it sets together.
struct AxisPlace {
  std::string label;
  std::vector<StudySetting> settings;
  std::string method; ///< that runs this place; empty: each of the study's methods
  int method_line = 0;
};

struct StudyAxis {
  std::string name;
  int line = 0;
  std::vector<AxisPlace> places;
};

struct Study {
  std::string name, path, text;
  std::string scene, array;
  std::int64_t steps = 0;           ///< 0: the scene's
  std::vector<std::string> methods; ///< where the file names none: the default level
  int methods_line = 0, times_line = 0;
  std::vector<double> times;   ///< s
  std::vector<StudyAxis> axes; ///< in the order of the file

  std::size_t combinations() const;
};

/// `study`: a path, or the name of a shipped study. Throws InputError, by line, for whatever is no study.
Study read_study(const std::string& study);
/// The study in `text`, which stands in the file `path`.
Study study_of(const std::string& text, const std::string& path);

} // namespace hopmesh::study
