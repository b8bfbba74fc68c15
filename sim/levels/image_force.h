// What an image does to a mesh in its plane: it pulls every node towards the edges of what it shows.
#pragma once

#include "sim/files/grey_picture.h"
#include "sim/scene/scene.h"

namespace hopmesh::levels {

/// The picture of force.image. Throws input::InputError for a file that is none, or that shows no edge.
files::GreyPicture picture_of(const scene::Scene& scene);

/// Adds a line where pixels of the picture are transparent.
void tell_of_picture(const scene::Scene& scene, std::vector<std::string>& notes);

/// Where a place stands in the picture, in pixels: column, row.
std::array<double, 2> pixel_of(const scene::ImageSpec& image, const double* place);

/// A node has the energy -strength * edge(place): edge is the slope of the smoothed picture, 1 where it is
/// steepest.
class ImageForce {
 public:
  explicit ImageForce(const scene::Scene& scene);

  /// Accelerations [3 * nodes] of nodes at these places; none outside the picture.
  const std::vector<double>& at(const std::vector<double>& positions);

 private:
  double slope_at(const std::vector<double>& slope, double column, double row) const;

  scene::ImageSpec image_;
  std::uint32_t width_, height_;
  double factor_;                     ///< from a pixel's slope to an acceleration
  std::vector<double> across_, down_; ///< slope of the edge strength at each pixel
  std::vector<double> force_;
};

} // namespace hopmesh::levels
