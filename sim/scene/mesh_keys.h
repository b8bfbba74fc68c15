// [mesh] of a scene file: its values, and a row for each of its keys. A new key of the mesh is a member and a
// row here.
#pragma once

#include "sim/input/key_table.h"
#include "sim/scene/limits.h"

namespace hopmesh::scene {

using input::Vector3;

struct Grid {
  int rows = 20, columns = 20;
  double pitch = 1.0;
};

/// Which nodes are pinned: names (pin_names) or node numbers.
using Pin = std::variant<std::string, std::int64_t>;
/// A list of pins as the value of a key.
input::Special pin_list(std::vector<Pin>& pins);

/// What a spring pulls with: its stretch times 2 alpha, or alpha whatever its length.
enum class SpringLaw : std::uint8_t { linear, tension };
inline constexpr std::array<std::string_view, 2> spring_law_names{"linear", "tension"};

enum class Axis : std::uint8_t { x, y, z };
inline constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

struct Start {
  double shuffle = 0;
  std::int64_t seed = 1;
  Vector3 velocity{0, 0, 0};
};

struct PinBall {
  Vector3 centre{0, 0, 0};
  double radius = 0;
};

struct MeshSpec {
  std::optional<Grid> grid;        ///< exactly one of grid and file is set
  std::optional<std::string> file; ///< path already resolved against the scene file's folder
  double scale = 1.0;
  Axis up = Axis::z;
  double pin_band = 0.02;
  double structural = 1.0, shear = 1.0, bend = 0.0; ///< alpha of each kind; 0: no such spring
  SpringLaw law = SpringLaw::linear;
  std::optional<double> floor; ///< none: of the mesh (mesh.h)
  std::vector<Pin> pinned;
  std::optional<PinBall> pin_ball;
  double mass = 1.0;
  std::optional<double> rest; ///< none: natural (as built)
  bool planar = false;
  Start start;
};

inline constexpr const char *grid_table = "mesh.grid", *file_key = "mesh.file";

// The rows below are in the order of scene files.

inline input::Keys shape_keys(MeshSpec& m) {
  using namespace input;
  const When of_file{m.file.has_value(), file_key, Otherwise::refused};
  const Range count{1, double(most_nodes), ""};
  return {
      Key(grid_table, Part{[&m] { m.grid.emplace(); }}, ""),
      Key("mesh.grid.rows", in(m.grid, &Grid::rows), count, "nodes from top to bottom")
          .allows("2 to 4,000,000 nodes in all"),
      Key("mesh.grid.columns", in(m.grid, &Grid::columns), count, "nodes from left to right")
          .allows("as above"),
      Key("mesh.grid.pitch", in(m.grid, &Grid::pitch), above_zero, "distance of neighbours").in_unit("m"),
      Key(file_key, &m.file, in_words("the path of an OBJ file"),
          "an OBJ file, from the scene file's folder (from where you stand with `--set`); instead of "
          "`mesh.grid`")
          .unset_is("none")
          .allows("a path"),
      Key("mesh.scale", &m.scale, above_zero, "factor on a file's coordinates").counts(of_file),
      Key("mesh.up", spec::choice(m.up, axis_names), "a file's axis along which `top` is highest")
          .counts(of_file),
      Key("mesh.pin_band", &m.pin_band, zero_to_one, "how much of a file's extent an end like `top` takes in")
          .counts(of_file),
  };
}

inline input::Keys spring_keys(MeshSpec& m) {
  using namespace input;
  const When of_grid{m.grid.has_value(), grid_table, Otherwise::nothing_but_zero,
                     "edges of a mesh file are structural springs"};
  const When of_tension{m.law == SpringLaw::tension, "law = \"tension\"", Otherwise::refused};
  return {
      Key("mesh.springs.structural", &m.structural, from_zero,
          "weight α of the springs along rows and columns, or of a file's edges; 0: none")
          .in_unit("J/m²")
          .leaves_out(0, "structural springs", "weight 0: not built"),
      Key("mesh.springs.shear", &m.shear, from_zero, "of both diagonals of a grid's squares; 0: none")
          .in_unit("J/m²")
          .counts(of_grid)
          .leaves_out(0, "shear springs", "weight 0: not built"),
      Key("mesh.springs.bend", &m.bend, from_zero,
          "of springs to the next but one in row and column; 0: none")
          .in_unit("J/m²")
          .counts(of_grid)
          .leaves_out(0, "bend springs", "weight 0: not built"),
      Key("mesh.springs.law", spec::choice(m.law, spring_law_names),
          "what a spring holds at length ℓ: `\"linear\"`, α (ℓ − L)²; `\"tension\"`, α ℓ: it pulls with α "
          "(then in J/m) at any length, and has no rest length"),
      Key("mesh.springs.floor", &m.floor, above_zero,
          "smooths ℓ to √(ℓ² + floor²); only beside `law = \"tension\"`")
          .in_unit("m")
          .counts(of_tension)
          .unset_is("a thousandth of the mean spring as built"),
  };
}
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
