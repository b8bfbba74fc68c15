// What `size` may lower on a scene's array, as whole numbers: fraction bits of each class, bits of the
// reciprocal, then threshold and sweeps of the relaxation, then lanes.
#pragma once

#include "sim/levels/array_port.h"
#include "sim/levels/built_mesh.h"
#include "sim/scene/scene_file.h"
#include "sim/study/size/least_setting.h"

namespace hopmesh::study {

/// The formats that may be lowered, in the order of spec::signal_classes. The accumulator is none of them:
/// its width follows from the others.
inline constexpr std::size_t format_knobs = spec::signal_classes.size() - 1;
constexpr spec::NumberFormat spec::Formats::*format_of(std::size_t knob) {
  std::size_t at = 0;
  for (const spec::SignalClass& signal : spec::signal_classes)
    if (signal.format != &spec::Formats::accumulator && at++ == knob) return signal.format;
  return nullptr;
}
constexpr std::size_t knob_of(spec::NumberFormat spec::Formats::*format) {
  std::size_t knob = 0;
  while (format_of(knob) != format) ++knob;
  return knob;
}

/// Places in a Setting. Levels of formats are bits behind the point; a level of the threshold fewer doubles
/// it, `scene_threshold` being the scene's own.
enum Knob : std::size_t {
  k_weight = knob_of(&spec::Formats::weight),
  k_state = knob_of(&spec::Formats::state),
  k_link = knob_of(&spec::Formats::link),
  k_reciprocal = format_knobs,
  k_threshold,
  k_sweeps,
  k_lanes,
  knob_count
};
inline constexpr int scene_threshold = 20;
/// Their keys.
extern const std::vector<std::string> knob_names;

class Sizing {
 public:
  /// `array`: its rounding, normaliser and schedule stay; its accumulator must be exact (InputError).
  Sizing(const scene::Inputs& inputs, const levels::BuiltMesh& mesh);

  /// Integer bits that the codes seen with the widest setting need, never more than the array had.
  void keep_integer_bits(const std::vector<levels::SignalRange>& seen);
  /// As many bits as an array can have; relaxation and lanes of scene and array.
  Setting widest() const;
  /// Formats: the link never finer than the state, so a state takes the link with it. None below what can be
  /// built, and where the array has no such part.
  std::optional<Setting> lowered(const Setting& from, std::size_t knob, int by) const;

  spec::ArraySpec array_of(const Setting& setting) const;
  scene::Inputs inputs_of(const Setting& setting) const;
  /// Memory and multipliers.
  double silicon_bits(const Setting& setting) const;
  /// The level as it stands in files: bits of the whole word, a threshold, a count.
  std::string text_of(const Setting& setting, std::size_t knob) const;
  /// --set words that make the setting of the scene with the array it was given.
  std::vector<std::string> overrides(const Setting& setting) const;

 private:
  int least(std::size_t knob) const;
  double threshold_of(const Setting& setting) const;

  const scene::Inputs inputs_;
  const levels::BuiltMesh& mesh_;
  spec::Formats formats_; ///< integer bits and modes
};

} // namespace hopmesh::study
