// A scene as data: what the scene file says, every key, defaults filled in (interfaces:
// docs/use/scene-files.md).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace hopmesh::scene {

using Vector3 = std::array<double, 3>;

struct Grid {
  int rows = 20, columns = 20;
  double pitch = 1.0; ///< m
};

/// Which nodes are pinned: names (left, right, top, bottom, corners) or node numbers.
using Pin = std::variant<std::string, std::int64_t>;

/// What a spring pulls with: its stretch times 2 alpha, or alpha whatever its length.
enum class SpringLaw { linear, tension };

/// Where free nodes start, and how fast: their places as built, or a random way off along each axis, the same
/// everywhere.
struct Start {
  double shuffle = 0; ///< m, at most, along each axis
  std::int64_t seed = 1;
  Vector3 velocity{0, 0, 0}; ///< m/s, of every free node
};

/// A place whose nodes are pinned: wherever a mesh, as built, lies inside.
struct PinBall {
  Vector3 centre{0, 0, 0}; ///< m
  double radius = 0;       ///< m
};

struct MeshSpec {
  std::optional<Grid> grid;        ///< exactly one of grid and file is set
  std::optional<std::string> file; ///< OBJ, path already resolved against the scene file's folder
  double scale = 1.0;              ///< file meshes: factor on coordinates
  double structural = 1.0, shear = 1.0, bend = 0.0; ///< alpha of each kind; 0: no such spring
  SpringLaw law = SpringLaw::linear;
  std::optional<double> floor; ///< tension: length that smooths the shortest; none: of the mesh (mesh.h)
  std::vector<Pin> pinned;
  std::optional<PinBall> pin_ball; ///< pinned beside those
  double pin_band = 0.02; ///< file meshes: `top` is the part of the extent within this share of the highest
  std::string up = "z";   ///< file meshes: the axis along which `top` is highest: x, y or z
  double mass = 1.0;      ///< kg per node
  std::optional<double> rest; ///< rest length of every spring; none: natural (as built)
  bool planar = false;        ///< two neurons a node, along x and z
  Start start;
};

enum class Formulation { probe, incremental };

struct MotionSpec {
  Formulation formulation = Formulation::probe;
  double time_step = 0.05; ///< s
  std::int64_t steps = 400;
  double friction = 0.99; ///< factor on v each step
};

struct ProbeSpec {
  double gamma = 4000.0;
  double beta = 1.0; ///< beta_i = beta dt^4 mean alpha of the node's springs
  double acceleration_memory = 0.0;
  std::string energy_springs = "own"; ///< own | all
  std::string force_on = "velocity";  ///< velocity | acceleration
};

struct IncrementalSpec {
  std::string rule = "backward_euler"; ///< backward_euler | bdf2 | static
};

struct RelaxSpec {
  double threshold = 1e-4;
  std::int64_t max_sweeps = 300;
  std::int64_t expansions = 1;
};

/// A picture in the x-z plane, its top left pixel at the origin, that pulls nodes to the edges it shows.
struct ImageSpec {
  std::string file;       ///< PGM or PNG, path already resolved against the scene file's folder
  double pitch = 1.0;     ///< m from pixel to pixel
  double strength = 1.0;  ///< J that a node on the strongest edge has less
  double smoothing = 2.0; ///< standard deviation in pixels
};

struct ForceSpec {
  Vector3 gravity{0, 0, 0}; ///< m/s^2
  std::optional<Vector3> wind;
  std::optional<ImageSpec> image;
  double drag = 0; ///< 1/s: -drag * v is added to every free node's acceleration
};

struct Scene {
  std::string name;
  std::string source;               ///< the file it was read from
  std::map<std::string, int> lines; ///< where the source sets each key, for messages; 0: an override did
  MeshSpec mesh;
  MotionSpec motion;
  ProbeSpec probe;
  IncrementalSpec incremental;
  RelaxSpec relax;
  ForceSpec force;

  /// As reference and firmware call it: probe, or the rule of an incremental one.
  std::string formulation_name() const {
    return motion.formulation == Formulation::probe ? "probe" : incremental.rule;
  }

  /// Steps look for the least potential energy; nothing has a speed.
  bool is_static() const {
    return motion.formulation == Formulation::incremental && incremental.rule == "static";
  }
};

} // namespace hopmesh::scene
