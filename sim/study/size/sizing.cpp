#include "sim/study/size/sizing.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/machine/silicon.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::study {

namespace {

std::vector<std::string> names_of_knobs() {
  std::vector<std::string> names;
  spec::ArraySpec any;
  for (const spec::ArrayKey& key : spec::format_keys(any))
    if (std::holds_alternative<spec::NumberFormat*>(key.place)) names.push_back(key.name);
  for (const char* name : {"array.reciprocal_bits", "relax.threshold", "relax.max_sweeps", "array.lanes"})
    names.emplace_back(name);
  return names;
}

int integer_bits_for(const levels::SignalRange& seen) {
  const double last_place = std::ldexp(1.0, -seen.format.fraction_bits());
  const double least = static_cast<double>(seen.least) * last_place;
  const double most = static_cast<double>(seen.largest) * last_place;
  int bits = 1;
  while (least < -std::ldexp(1.0, bits - 1) || most >= std::ldexp(1.0, bits - 1)) ++bits;
  return bits;
}

} // namespace

const std::vector<std::string> knob_names = names_of_knobs();

Sizing::Sizing(const scene::Inputs& inputs, const levels::BuiltMesh& mesh)
    : inputs_(inputs), mesh_(mesh), formats_(inputs.array.formats) {
  if (!inputs.array.exact_accumulator)
    throw input::input_error("", 0, "formats.accumulator", inputs.array.formats.accumulator.text(),
                             "\"exact\": its width follows from the others");
}

void Sizing::keep_integer_bits(const std::vector<levels::SignalRange>& seen) {
  for (const levels::SignalRange& range : seen) {
    const int needed = integer_bits_for(range);
    if (range.signal == "weight")
      formats_.weight.integer_bits = std::min(formats_.weight.integer_bits, needed);
    if (range.signal == "bias") formats_.bias.integer_bits = std::min(formats_.bias.integer_bits, needed);
  }
}

// Weight and link share what an exact sum may have behind its point.
Setting Sizing::widest() const {
  spec::Formats whole = formats_;
  whole.weight.width = whole.weight.integer_bits, whole.link.width = whole.link.integer_bits;
  whole.bias.width = whole.bias.integer_bits;
  const int room =
      spec::most_sum_width - spec::exact_accumulator_format(whole, mesh_.topology().most_taps()).width;
  const auto bits = [](int fraction, const spec::NumberFormat& f) {
    return std::min(fraction, spec::most_width - f.integer_bits);
  };
  Setting all(knob_count);
  for (std::size_t knob = 0; knob < format_knobs; ++knob) all[knob] = bits(room, formats_.*format_of(knob));
  all[k_weight] = bits(room / 2, formats_.weight);
  all[k_link] = std::min(all[k_state], bits(room - all[k_weight], formats_.link));
  const bool reciprocal = inputs_.array.normaliser == spec::Normaliser::reciprocal;
  all[k_reciprocal] = reciprocal ? spec::most_reciprocal_bits : inputs_.array.reciprocal_bits;
  all[k_threshold] = scene_threshold;
  all[k_sweeps] = static_cast<int>(inputs_.scene.relax.max_sweeps);
  all[k_lanes] = inputs_.array.lanes;
  return all;
}

int Sizing::least(std::size_t knob) const {
  if (knob == k_reciprocal) return spec::least_reciprocal_bits;
  if (knob == k_threshold) return 0;
  if (knob >= format_knobs) return 1;
  return std::max(1, spec::least_width - (formats_.*format_of(knob)).integer_bits);
}

std::optional<Setting> Sizing::lowered(const Setting& from, std::size_t knob, int by) const {
  if (knob == k_reciprocal && inputs_.array.normaliser != spec::Normaliser::reciprocal) return std::nullopt;
  if (knob == k_threshold && inputs_.scene.relax.threshold == 0) return std::nullopt;
  Setting lower = from;
  lower[knob] -= by;
  if (lower[knob] < least(knob)) return std::nullopt;
  lower[k_link] = std::min(lower[k_link], lower[k_state]);
  return lower;
}

spec::ArraySpec Sizing::array_of(const Setting& setting) const {
  spec::ArraySpec array = inputs_.array;
  array.formats = formats_;
  for (std::size_t knob = 0; knob < format_knobs; ++knob) {
    spec::NumberFormat& format = array.formats.*format_of(knob);
    format.width = format.integer_bits + setting[knob];
  }
  if (array.normaliser == spec::Normaliser::reciprocal) array.reciprocal_bits = setting[k_reciprocal];
  array.lanes = setting[k_lanes];
  array.name = "size";
  return array;
}

double Sizing::threshold_of(const Setting& setting) const {
  return std::ldexp(inputs_.scene.relax.threshold, scene_threshold - setting[k_threshold]);
}

scene::Inputs Sizing::inputs_of(const Setting& setting) const {
  scene::Inputs inputs{inputs_.scene, array_of(setting)};
  inputs.scene.relax.threshold = threshold_of(setting);
  inputs.scene.relax.max_sweeps = setting[k_sweeps];
  return inputs;
}

double Sizing::silicon_bits(const Setting& setting) const {
  const spec::ArraySpec array = array_of(setting);
  return static_cast<double>(machine::memory_bits(array, mesh_.topology()).total() +
                             machine::multiplier_bits(array, mesh_.topology()).total());
}

std::string Sizing::text_of(const Setting& setting, std::size_t knob) const {
  if (knob == k_threshold) return fmt::format("{}", threshold_of(setting));
  if (knob >= format_knobs) return fmt::format("{}", setting[knob]);
  return (array_of(setting).formats.*format_of(knob)).text();
}

std::vector<std::string> Sizing::overrides(const Setting& setting) const {
  const Setting scenes = widest();
  std::vector<std::string> words;
  for (std::size_t knob = 0; knob < knob_count; ++knob) {
    if (knob == k_reciprocal && inputs_.array.normaliser != spec::Normaliser::reciprocal) continue;
    const bool relaxation = knob == k_threshold || knob == k_sweeps;
    if (relaxation && setting[knob] == scenes[knob]) continue;
    words.push_back(fmt::format("{}={}", knob_names[knob], text_of(setting, knob)));
  }
  return words;
}

} // namespace hopmesh::study
