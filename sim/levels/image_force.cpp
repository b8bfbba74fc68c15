#include "sim/levels/image_force.h"

#include "sim/input/count_text.h"
#include "sim/input/whole_file.h"
#include "sim/scene/scene_reader.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::levels {
namespace {

using files::GreyPicture;

constexpr std::size_t most_bytes = std::size_t{1} << 28;

/// A pixel, or the nearest one of the picture's border.
double pixel(const GreyPicture& p, std::int64_t row, std::int64_t column) {
  return p.at(static_cast<std::uint32_t>(std::clamp<std::int64_t>(row, 0, p.height - 1)),
              static_cast<std::uint32_t>(std::clamp<std::int64_t>(column, 0, p.width - 1)));
}

template <typename Value> GreyPicture mapped(const GreyPicture& from, Value value) {
  GreyPicture result{from.width, from.height, {}};
  result.shade.reserve(from.shade.size());
  for (std::int64_t row = 0; row < from.height; ++row)
    for (std::int64_t column = 0; column < from.width; ++column) result.shade.push_back(value(row, column));
  return result;
}

// Twice 1/4 1/2 1/4, along and across, is a bell of standard deviation 1; k times makes one of sqrt k. Sums
// and products alone: the same bits on every machine.
GreyPicture smoothed(GreyPicture picture, double deviation) {
  const auto passes = std::llround(2 * deviation * deviation);
  for (std::int64_t k = 0; k < passes; ++k) {
    const GreyPicture along = mapped(picture, [&](std::int64_t r, std::int64_t c) {
      return (pixel(picture, r, c - 1) + 2 * pixel(picture, r, c) + pixel(picture, r, c + 1)) / 4;
    });
    picture = mapped(along, [&](std::int64_t r, std::int64_t c) {
      return (pixel(along, r - 1, c) + 2 * pixel(along, r, c) + pixel(along, r + 1, c)) / 4;
    });
  }
  return picture;
}

double across_at(const GreyPicture& p, std::int64_t r, std::int64_t c) {
  return (pixel(p, r, c + 1) - pixel(p, r, c - 1)) / 2;
}
double down_at(const GreyPicture& p, std::int64_t r, std::int64_t c) {
  return (pixel(p, r + 1, c) - pixel(p, r - 1, c)) / 2;
}

/// How steep the smoothed picture is, as a share of its steepest place; all 0 where nothing is to be seen.
GreyPicture edges_of(const GreyPicture& picture, double deviation) {
  const GreyPicture smooth = smoothed(picture, deviation);
  GreyPicture edges = mapped(smooth, [&](std::int64_t r, std::int64_t c) {
    const double across = across_at(smooth, r, c), down = down_at(smooth, r, c);
    return std::sqrt(across * across + down * down);
  });
  const double steepest = *std::max_element(edges.shade.begin(), edges.shade.end());
  if (steepest > 0)
    for (double& edge : edges.shade) edge /= steepest;
  return edges;
}

} // namespace

GreyPicture picture_of(const scene::Scene& scene) {
  const std::string bytes =
      input::read_whole_file(scene.force.image->file, "a PGM or PNG picture", most_bytes);
  const auto refused = [&](const std::string& found, const char* expected) {
    return scene::scene_error(scene, "force.image.file", found + " in " + scene.force.image->file, expected);
  };
  GreyPicture picture;
  try {
    picture = files::read_grey(bytes, scene.force.image->ground);
  } catch (const files::NoPicture& why) {
    throw refused(why.what(), "a PGM or PNG picture");
  }
  if (picture.width < 2 || picture.height < 2)
    throw refused(std::to_string(picture.width) + " x " + std::to_string(picture.height) + " pixels",
                  "two rows and two columns at least");
  const auto [dark, bright] = std::minmax_element(picture.shade.begin(), picture.shade.end());
  if (*dark == *bright)
    throw picture.transparent > 0
        ? refused("one shade of grey, transparent pixels on their ground",
                  "a picture with an edge to settle on, or another force.image.ground")
        : refused("one shade of grey", "a picture with an edge to settle on");
  return picture;
}

void tell_of_picture(const scene::Scene& scene, std::vector<std::string>& notes) {
  const GreyPicture picture = picture_of(scene);
  if (picture.transparent == 0) return;
  notes.push_back(fmt::format("{}: {} of {} pixels are transparent and lie on a shade of {} "
                              "(force.image.ground: 0 black, 1 white)",
                              scene.force.image->file, input::grouped(picture.transparent),
                              input::grouped(picture.shade.size()), scene.force.image->ground));
}

std::array<double, 2> pixel_of(const scene::ImageSpec& image, const double* place) {
  return {place[0] / image.pitch, -place[2] / image.pitch};
}

ImageForce::ImageForce(const scene::Scene& scene) : image_(*scene.force.image) {
  const GreyPicture edges = edges_of(picture_of(scene), image_.smoothing);
  width_ = edges.width, height_ = edges.height;
  factor_ = image_.strength / image_.pitch / scene.mesh.mass;
  across_ = mapped(edges, [&](auto r, auto c) { return across_at(edges, r, c); }).shade;
  down_ = mapped(edges, [&](auto r, auto c) { return down_at(edges, r, c); }).shade;
}

// Between four pixels in proportion.
double ImageForce::slope_at(const std::vector<double>& slope, double column, double row) const {
  const auto c = std::min(static_cast<std::uint32_t>(column), width_ - 2),
             r = std::min(static_cast<std::uint32_t>(row), height_ - 2);
  const double right = column - c, below = row - r;
  const double* at = slope.data() + std::size_t{r} * width_ + c;
  return (1 - below) * ((1 - right) * at[0] + right * at[1]) +
         below * ((1 - right) * at[width_] + right * at[width_ + 1]);
}

const std::vector<double>& ImageForce::at(const std::vector<double>& positions) {
  force_.assign(positions.size(), 0.0);
  for (std::size_t k = 0; k < positions.size(); k += 3) {
    const auto [column, row] = pixel_of(image_, positions.data() + k);
    if (!(column >= 0 && row >= 0 && column <= width_ - 1 && row <= height_ - 1)) continue;
    force_[k] = factor_ * slope_at(across_, column, row);
    force_[k + 2] = -factor_ * slope_at(down_, column, row);
  }
  return force_;
}

} // namespace hopmesh::levels
