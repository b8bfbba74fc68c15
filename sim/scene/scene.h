// A scene as data: what the scene file says, every key, defaults filled in (interfaces:
// docs/use/scene-files.md).
#pragma once

#include "sim/scene/force_keys.h"
#include "sim/scene/host_keys.h"
#include "sim/scene/motion_keys.h"
#include "sim/scene/node_keys.h"

#include <map>

namespace hopmesh::scene {

struct Scene {
  std::string name;
  std::string source;               ///< the file it was read from
  std::map<std::string, int> lines; ///< where the source sets each key, for messages; 0: an override did
  MeshSpec mesh;
  MotionKeys motion;
  ProbeSpec probe;
  IncrementalSpec incremental;
  RelaxSpec relax;
  RivalSpec rival;
  ForceSpec force;
  HostSpec host;

  /// As reference and firmware call it: probe, or the rule of an incremental one.
  std::string formulation_name() const {
    return motion.formulation == Formulation::probe ? "probe" : name_of(incremental.rule);
  }

  /// Steps look for the least potential energy; nothing has a speed.
  bool is_static() const { return !moving(motion, incremental).holds; }
};

/// The table of a scene, in the order of scene files. Where a walker takes one, a caller may give it rows of
/// its own beside these.
input::Keys scene_keys(Scene& scene);
using SceneTable = input::Keys (*)(Scene&);

} // namespace hopmesh::scene
