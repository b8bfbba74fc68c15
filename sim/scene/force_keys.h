// [force] of a scene file: its values, and a row for each key.
#pragma once

#include "sim/scene/motion_keys.h"

namespace hopmesh::scene {

using input::Vector3;

/// A picture in the x-z plane, its top left pixel at the origin, that pulls nodes to the edges it shows.
struct ImageSpec {
  std::string file; ///< path already resolved against the scene file's folder
  double pitch = 1.0;
  double strength = 1.0;
  double smoothing = 2.0;
  double ground = 0;
};

struct ForceSpec {
  Vector3 gravity{0, 0, 0};
  std::optional<Vector3> wind;
  double drag = 0;
  std::optional<ImageSpec> image;
};

/// What a step leaves of a velocity that nothing drives.
inline double kept_speed(const MotionKeys& m, const ForceSpec& f) {
  return m.friction / (1 + f.drag * m.time_step);
}

inline constexpr const char* image_key = "force.image.file";

/// In the order of scene files. `moving`: whether anything has a speed.
inline input::Keys force_keys(ForceSpec& f, const input::When& moving) {
  using namespace input;
  return {
      Key("force.gravity", &f.gravity, "acceleration of every free node")
          .in_unit("m/s²")
          .leaves_out(0, "gravity", "none given"),
      Key("force.wind", &f.wind, "an acceleration too, added to gravity")
          .in_unit("m/s²")
          .unset_is("none")
          .leaves_out(0, "wind", "none given"),
      Key("force.drag", &f.drag, from_zero, "of still air, c: adds −c · v to every free node's acceleration")
          .in_unit("1/s")
          .counts(moving)
          .leaves_out(0, "drag of the air", "none given"),
      Key("force.image", Part{[&f] { f.image.emplace(); }, "file", "no file", "file = a PGM or PNG picture"},
          ""),
      Key(image_key, in(f.image, &ImageSpec::file), in_words("the path of a PGM or PNG picture"),
          "a PGM or PNG picture whose edges pull the nodes, from the scene file's folder; incremental "
          "formulation only")
          .unset_is("none")
          .allows("a path"),
      Key("force.image.pitch", in(f.image, &ImageSpec::pitch), above_zero,
          "from pixel to pixel: column c, row r at x = c · pitch, z = −r · pitch")
          .in_unit("m"),
      Key("force.image.strength", in(f.image, &ImageSpec::strength), from_zero,
          "what a node on the strongest edge has less")
          .in_unit("J"),
      Key("force.image.smoothing", in(f.image, &ImageSpec::smoothing),
          {0.5, 50, "a number of pixels from 0.5 to 50"},
          "standard deviation of the bell that smooths the picture first")
          .in_unit("pixels"),
      Key("force.image.ground", in(f.image, &ImageSpec::ground), zero_to_one,
          "shade that transparent pixels lie on: 0 black, 1 white; the program tells where there are some"),
  };
}

} // namespace hopmesh::scene
