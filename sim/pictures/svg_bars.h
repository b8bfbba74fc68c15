// Parts of a whole along time: at the left stacked bars whose height is the whole, at the right how long each
// part is, on a logarithmic scale.
#pragma once

#include <string>
#include <vector>

namespace hopmesh::pictures {

/// A part, at each place along x.
struct BarPart {
  std::string name;
  std::vector<double> stacked; ///< signed; the parts of a place add up to the whole
  std::vector<double> length;  ///< of the part alone
};

struct StackedBars {
  std::string title, note, x_label, y_label, stacked_title, length_title;
  std::vector<double> x; ///< rising
  std::vector<BarPart> parts;
  std::vector<double> floor; ///< what is below means nothing; drawn where it is above 0
  std::string floor_name;
};

std::string svg_of(const StackedBars& bars);

} // namespace hopmesh::pictures
