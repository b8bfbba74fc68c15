// Keys of an array that no program knows: a number, a mode and a format, as rows beside the others.
#pragma once

#include "rtl_model/spec/array_keys.h"

namespace hopmesh::tests::own {

inline int depth;
enum class Colour : std::uint8_t { red, blue };
inline constexpr std::array<std::string_view, 2> colour_names{"red", "blue"};
inline Colour colour;
inline spec::NumberFormat ratio;

inline spec::ArrayKeys with_more(spec::ArraySpec& array) {
  spec::ArrayKeys keys = spec::array_keys(array);
  keys.push_back(
      spec::ArrayKey("array.depth", &depth, "of the pipeline").allows({"1 to 9", 1, 9}).in_vectors(16));
  keys.push_back(
      spec::ArrayKey("array.colour", spec::choice(colour, colour_names), "of the box").in_vectors(17));
  keys.push_back(spec::ArrayKey("formats.ratio", &ratio, "a ratio").in_vectors(18));
  return keys;
}

inline void set(int d, Colour c, const spec::NumberFormat& f) {
  depth = d, colour = c, ratio = f;
}

inline constexpr spec::NumberFormat narrow{9, 3, spec::Rounding::rnd, spec::Overflow::wrap};

} // namespace hopmesh::tests::own
