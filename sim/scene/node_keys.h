// [mesh] of a scene file: a row for each key of the nodes: pins, mass, rest, start.
#pragma once

#include "sim/scene/mesh_keys.h"

namespace hopmesh::scene {

inline input::Keys node_keys(MeshSpec& m) {
  using namespace input;
  const Range length{0, 1e15, "\"natural\" or a length from 0 to 1e15"};
  return {
      Key("mesh.pinned", pin_list(m.pinned), "nodes that never move").allows("see below"),
      Key("mesh.pin_ball",
          Part{[&m] { m.pin_ball.emplace(); }, "radius", "no radius",
               "{ centre = [x, y, z], radius = a length above 0 }"},
          ""),
      Key("mesh.pin_ball.centre", in(m.pin_ball, &PinBall::centre),
          "nodes that never move, beside those: all that lie, as built, in a ball about this place")
          .in_unit("m"),
      Key("mesh.pin_ball.radius", in(m.pin_ball, &PinBall::radius), above_zero,
          "of that ball, its skin included; a ball must hold a node")
          .in_unit("m")
          .unset_is("no ball"),
      Key("mesh.mass", &m.mass, above_zero, "of every node; in the probe only kinetic energy shows it")
          .in_unit("kg"),
      Key("mesh.rest", Worded{"natural", &m.rest}, length,
          "rest length of every spring; `\"natural\"`: as built")
          .in_unit("m")
          .leaves_out(0, "error of the expansion", "rest length 0: the energy is quadratic"),
      Key("mesh.planar", &m.planar, "two neurons a node, along x and z; y never moves"),
      Key("mesh.start.shuffle", &m.start.shuffle, from_zero,
          "free nodes start up to so far off their places, along each axis; springs keep their rest lengths")
          .in_unit("m"),
      Key("mesh.start.seed", &m.start.seed, {0, 0x1p63, ""},
          "which of the random starts; the same places on every machine (SplitMix64)")
          .counts({m.start.shuffle > 0, "mesh.start.shuffle above 0"})
          .allows("0 to 2^63 − 1"),
      Key("mesh.start.velocity", &m.start.velocity,
          "of every free node; none in the static rule, 0 along y in planar meshes")
          .in_unit("m/s"),
  };
}

} // namespace hopmesh::scene
