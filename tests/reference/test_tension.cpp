// Constant tension: a spring that pulls alike at any length. Its expansion against differences of its energy,
// and the trees and nets that come of it against closed forms (docs/findings/trees-surfaces-snakes.md).
#include "tests/reference/random_inputs.h"
#include "tests/reference/static_motion.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace reference;

/// A tree in the plane y = 0: its terminals first.
scene::Mesh tree(const std::vector<std::array<double, 2>>& nodes, std::size_t terminals,
                 const std::vector<std::array<std::uint32_t, 2>>& springs) {
  scene::Mesh mesh;
  mesh.planar = true;
  mesh.law = scene::SpringLaw::tension;
  mesh.floor = 1e-4;
  for (const auto& [x, z] : nodes) {
    mesh.pinned.push_back(mesh.position.size() < terminals);
    mesh.position.push_back({x, 0, z});
  }
  for (const auto& [a, b] : springs) mesh.springs.push_back({{a, b}, 1, 0});
  return mesh;
}

State at_rest(const scene::Mesh& mesh) {
  State state = initial_state(mesh, statics);
  for (int step = 0; step < 60; ++step) advance(mesh, static_motion(), one_by_one(state.V.size()), state);
  return state;
}

double length_of(const scene::Mesh& mesh, const Vector& position) {
  double sum = 0;
  for (const scene::Spring& s : mesh.springs)
    sum += (position.segment<3>(3 * s.node[0]) - position.segment<3>(3 * s.node[1])).norm();
  return sum;
}

TEST(ReferenceTension, TheEnergyIsThePullTimesTheSmoothedLength) {
  scene::Mesh mesh = tree({{0, 0}, {3, 4}, {3, 4}}, 1, {{0, 1}, {1, 2}});
  mesh.floor = 12;
  mesh.springs[0].weight = 2;
  const State state = initial_state(mesh);
  EXPECT_DOUBLE_EQ(spring_energy(mesh, state.position), 2 * 13 + 12);
}

// 3, 4, 5: the squares of the sides, halved, and 2 sqrt 3 times the area, make the square of the length.
TEST(ReferenceTension, ThreeTerminalsMeetAtAHundredAndTwentyDegrees) {
  const scene::Mesh mesh = tree({{0, 0}, {4, 0}, {0, 3}, {2, 2}}, 3, {{0, 3}, {1, 3}, {2, 3}});
  const State state = at_rest(mesh);
  EXPECT_NEAR(length_of(mesh, state.position), std::sqrt(25 + 12 * std::sqrt(3.0)), 1e-7);
  const auto towards = [&](int terminal) {
    return Eigen::Vector3d(state.position.segment<3>(3 * terminal) - state.position.segment<3>(9))
        .normalized();
  };
  EXPECT_NEAR(towards(0).dot(towards(1)), -0.5, 1e-6);
  EXPECT_NEAR(towards(1).dot(towards(2)), -0.5, 1e-6);
}

TEST(ReferenceTension, WhereLinearSpringsGiveTheCentroid) {
  scene::Mesh mesh = tree({{0, 0}, {4, 0}, {0, 3}, {2, 2}}, 3, {{0, 3}, {1, 3}, {2, 3}});
  mesh.law = scene::SpringLaw::linear;
  const State state = at_rest(mesh);
  EXPECT_NEAR(state.position[9], 4.0 / 3, 1e-10);
  EXPECT_NEAR(state.position[11], 1, 1e-10);
}

/// Least length over the free nodes of a tree by going to and fro along every coordinate: slow, and nothing
/// to do with springs. The length is convex; where several nodes must move together it creeps, so the stride
/// along each node's and all pairs' coordinates is halved only when none of them helps.
double least_length(const scene::Mesh& mesh) {
  Vector x = initial_state(mesh).position;
  double best = length_of(mesh, x);
  for (double stride = 0.25; stride > 1e-7;) {
    bool better = false;
    for (std::size_t a = 0; a < mesh.nodes(); ++a)
      for (std::size_t b = a; b < mesh.nodes(); ++b)
        for (int way = 0; way < 16 && !mesh.pinned[a] && !mesh.pinned[b]; ++way) {
          Vector moved = x;
          moved[3 * a + (way & 1 ? 2 : 0)] += way & 2 ? stride : -stride;
          moved[3 * b + (way & 4 ? 2 : 0)] += way & 8 ? stride : -stride;
          const double length = length_of(mesh, moved);
          if (length < best) best = length, x = moved, better = true;
        }
    if (!better) stride /= 2;
  }
  return best;
}

TEST(ReferenceTension, TheTreesOfASquareAndOfALadderAreTheShortest) {
  const scene::Mesh square = tree({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.4, 0.45}, {0.7, 0.6}}, 4,
                                  {{0, 4}, {3, 4}, {1, 5}, {2, 5}, {4, 5}});
  const scene::Mesh ladder =
      tree({{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}, {0.3, 0.5}, {0.8, 0.4}, {1.2, 0.6}, {1.7, 0.5}},
           6, {{0, 6}, {3, 6}, {6, 7}, {7, 8}, {8, 9}, {1, 7}, {4, 8}, {2, 9}, {5, 9}});
  const double root = std::sqrt(3.0);
  const double of_square = 1 + root, of_ladder = std::sqrt(std::pow(3 * (1 + root / 2) - 1, 2) + 0.25);
  EXPECT_NEAR(least_length(square), of_square, 1e-5);
  EXPECT_NEAR(least_length(ladder), of_ladder, 1e-5);
  EXPECT_NEAR(length_of(square, at_rest(square).position), of_square, 1e-6);
  EXPECT_NEAR(length_of(ladder, at_rest(ladder).position), of_ladder, 1e-6);
}

} // namespace
} // namespace hopmesh::tests
