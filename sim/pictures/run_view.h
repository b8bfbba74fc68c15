// What the pictures of a run need, as plain data: the run fills it in; glTF, report and picture.svg draw it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hopmesh::pictures {

/// A corner of a triangle: node, and texture coordinates with (0,0) at the picture's top left.
struct ViewCorner {
  std::uint32_t node;
  float u, v;
};

struct ViewSpring {
  std::uint32_t node[2];
  float rest_length;
};

/// A figure over the steps, as the report heads its chart; the unit may be empty.
struct Series {
  std::string name, unit;
  std::vector<double> values;
};

/// A figure with its name and unit, as text ready to read.
struct Figure {
  std::string name, value;
};

/// A picture of its own, under a heading.
struct Drawing {
  std::string title, svg;
};

struct RunView {
  std::string title;    ///< scene name
  std::string subtitle; ///< one line: level, steps, array
  std::string outcome;  ///< one sentence: done, interrupted or diverged, and why
  bool good = true;     ///< false: diverged
  bool rested = true;   ///< false: steps stopped before they came to rest
  std::size_t nodes = 0;
  std::vector<bool> pinned;
  std::vector<std::array<ViewCorner, 3>> triangles;
  std::vector<ViewSpring> springs;
  bool crest = true;                      ///< draw our crest on the surface
  std::string up = "z";                   ///< axis that points up: x, y or z
  std::array<double, 3> origin{0, 0, 0};  ///< m: where the scene has what frames call 0
  std::vector<std::vector<float>> frames; ///< positions [nodes * 3] of the frames shown, less the origin
  std::vector<double> frame_times;        ///< s
  std::vector<double> frame_steps;
  std::vector<double> step_times; ///< s, abscissa of the series
  std::vector<Series> series;
  std::vector<std::pair<std::string, std::vector<Figure>>>
      tables;                    ///< e.g. {"The array", {...}}, {"Speed", {...}}
  std::vector<Drawing> drawings; ///< above the tables
  std::string manifest;          ///< manifest.json as text
};

} // namespace hopmesh::pictures
