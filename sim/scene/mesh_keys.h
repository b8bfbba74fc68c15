// [mesh] of a scene file: its values, and a row for each key of shape and springs; those of the nodes are in
// node_keys.h. A new key of the mesh is a member here and a row.
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

/// What becomes of a file's vertices that no face or line uses; kept ones are pinned.
enum class Loose : std::uint8_t { drop, keep };
inline constexpr std::array<std::string_view, 2> loose_names{"drop", "keep"};

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
  Loose loose = Loose::drop;
  bool weld = false;
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
      Key("mesh.loose", spec::choice(m.loose, loose_names),
          "a file's vertices that no face or line uses: left out, which the program tells, or kept as pinned "
          "nodes, so that a node's number is the vertex's less 1")
          .counts(of_file),
      Key("mesh.weld", &m.weld, "a file's vertices at one and the same place become one node")
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

} // namespace hopmesh::scene
