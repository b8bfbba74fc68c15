#include "sim/pictures/coarse_view.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace hopmesh::pictures {

namespace {

bool is_finite(const float* position) {
  return std::isfinite(position[0]) && std::isfinite(position[1]) && std::isfinite(position[2]);
}

float longest_side(const std::vector<float>& frame) {
  float least[3] = {INFINITY, INFINITY, INFINITY}, most[3] = {-INFINITY, -INFINITY, -INFINITY}, side = 0;
  for (std::size_t k = 0; k < frame.size(); ++k)
    if (std::isfinite(frame[k]))
      least[k % 3] = std::min(least[k % 3], frame[k]), most[k % 3] = std::max(most[k % 3], frame[k]);
  for (std::size_t k = 0; k < 3; ++k) side = std::max(side, most[k] - least[k]);
  return side;
}

/// The number of each node's cube; nodes whose place is no number share one of their own.
std::vector<std::uint32_t> cubes_of(const std::vector<float>& frame, float side) {
  std::map<std::array<float, 3>, std::uint32_t> numbers;
  std::vector<std::uint32_t> found;
  for (std::size_t k = 0; k < frame.size(); k += 3) {
    std::array<float, 3> place{HUGE_VALF, 0, 0};
    if (is_finite(&frame[k]))
      for (std::size_t d = 0; d < 3; ++d) place[d] = std::floor(frame[k + d] / side);
    found.push_back(numbers.try_emplace(place, static_cast<std::uint32_t>(numbers.size())).first->second);
  }
  return found;
}

std::vector<float> middles(const std::vector<float>& frame, const std::vector<std::uint32_t>& cube,
                           std::size_t cubes) {
  std::vector<double> sum(3 * cubes), count(cubes);
  for (std::size_t n = 0; n < cube.size(); ++n) {
    count[cube[n]] += 1;
    for (std::size_t d = 0; d < 3; ++d) sum[3 * cube[n] + d] += double{frame[3 * n + d]};
  }
  std::vector<float> middle;
  for (std::size_t k = 0; k < sum.size(); ++k) middle.push_back(static_cast<float>(sum[k] / count[k / 3]));
  return middle;
}

using Frames = std::vector<const std::vector<float>*>;

RunView merged(const RunView& view, double cubes, const Frames& frames) {
  const std::vector<float>& end = view.frames.back();
  const float side = longest_side(end) / static_cast<float>(cubes);
  const auto cube = cubes_of(end, std::max(side, 1e-30f)); // a mesh in one place has no side
  RunView coarse;
  coarse.up = view.up;
  coarse.nodes = 1 + *std::max_element(cube.begin(), cube.end());
  coarse.pinned.assign(coarse.nodes, false);
  for (std::size_t n = 0; n < view.nodes; ++n)
    if (view.pinned[n]) coarse.pinned[cube[n]] = true;
  for (const auto* frame : frames) coarse.frames.push_back(middles(*frame, cube, coarse.nodes));
  std::set<std::set<std::uint32_t>> there;
  for (const auto& t : view.triangles) {
    const std::uint32_t a = cube[t[0].node], b = cube[t[1].node], c = cube[t[2].node];
    if (a != b && b != c && c != a && there.insert({a, b, c}).second)
      coarse.triangles.push_back({{{a, 0, 0}, {b, 0, 0}, {c, 0, 0}}});
  }
  for (const ViewSpring& s : view.springs) {
    const std::uint32_t a = cube[s.node[0]], b = cube[s.node[1]];
    if (a != b && there.insert({a, b}).second) coarse.springs.push_back({{a, b}, 0});
  }
  return coarse;
}

} // namespace

RunView coarse_view(const RunView& view, double cubes) {
  return merged(view, cubes, {&view.frames.front(), &view.frames.back()});
}

RunView light_view(const RunView& view, double cubes) {
  Frames frames;
  for (const std::vector<float>& frame : view.frames) frames.push_back(&frame);
  RunView light = merged(view, cubes, frames);
  light.title = view.title, light.subtitle = view.subtitle, light.outcome = view.outcome;
  light.good = view.good, light.crest = false; // merged corners have no place on a texture
  light.frame_times = view.frame_times, light.frame_steps = view.frame_steps;
  light.step_times = view.step_times, light.series = view.series;
  light.tables = view.tables, light.manifest = view.manifest;
  return light;
}

} // namespace hopmesh::pictures
