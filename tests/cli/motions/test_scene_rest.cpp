// Shipped scenes that come to rest, against a sparse factorisation and against the balance of forces.
#include "sim/scene/mesh.h"
#include "sim/scene/scene_file.h"
#include "tests/cli/motions/scene_motion.h"

#include <Eigen/SparseCholesky>

namespace hopmesh::tests {
namespace {

constexpr double earth_gravity = 9.81;

scene::Mesh mesh_of(const std::string& name) {
  return scene::build_mesh(scene::read_inputs(name, "", {}).scene);
}

/// Where the springs of `net`, which have no rest length, balance its weight: coordinate by coordinate one
/// system for all nodes, in which a pinned one is where it is.
std::vector<scene::Vector3> balanced(const scene::Mesh& mesh) {
  const auto n = static_cast<Eigen::Index>(mesh.nodes());
  std::vector<scene::Vector3> result(mesh.position);
  for (const int p : {0, 2}) {
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      right[i] = mesh.pinned[i] ? mesh.position[i][p] : p == 2 ? -mesh.mass * earth_gravity : 0;
      if (mesh.pinned[i]) entries.emplace_back(i, i, 1);
    }
    for (const scene::Spring& spring : mesh.springs)
      for (int end = 0; end < 2; ++end) {
        const auto i = spring.node[end], j = spring.node[1 - end];
        if (mesh.pinned[i]) continue;
        entries.emplace_back(i, i, 2 * spring.weight);
        if (mesh.pinned[j])
          right[i] += 2 * spring.weight * mesh.position[j][p];
        else
          entries.emplace_back(i, j, -2 * spring.weight);
      }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd x = Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
    for (Eigen::Index i = 0; i < n; ++i) result[i][p] = x[i];
  }
  return result;
}

double largest_error(const Positions& p, std::size_t step, const std::vector<scene::Vector3>& wanted) {
  double error = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) error = std::max(error, std::fabs(p.at(step, i, k) - wanted[i][k]));
  return error;
}

// Each step takes away what the one before left, at a scale that fits it: words bound a step, not the answer.
TEST_F(SceneMotion, NetIsOneSparseSolve) {
  const auto wanted = balanced(mesh_of("net"));
  const Positions array = positions("net");
  EXPECT_LT(largest_error(exact("net --steps 1"), 1, wanted), 1e-9) << "one step, in double";
  EXPECT_LT(largest_error(array, 1, wanted), 0.1) << "of a sag of metres";
  EXPECT_GT(largest_error(array, 1, wanted), 1e-5) << "one step at 16 bits cannot be that good";
  EXPECT_LT(largest_error(array, 8, wanted), 1e-6);
}

/// The largest force that springs and weight leave on a free node, over its weight.
double imbalance(const scene::Mesh& mesh, const Positions& p, std::size_t step) {
  std::vector<Eigen::Vector3d> force(mesh.nodes(), {0, 0, -mesh.mass * earth_gravity});
  for (const scene::Spring& s : mesh.springs) {
    Eigen::Vector3d u;
    for (int k = 0; k < 3; ++k) u[k] = p.at(step, s.node[1], k) - p.at(step, s.node[0], k);
    const Eigen::Vector3d pull = 2 * s.weight * (1 - s.rest_length / u.norm()) * u;
    force[s.node[0]] += pull, force[s.node[1]] -= pull;
  }
  double largest = 0;
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    if (!mesh.pinned[i]) largest = std::max(largest, force[i].norm());
  return largest / (mesh.mass * earth_gravity);
}

TEST_F(SceneMotion, ClothRestsWhereForcesBalance) {
  const scene::Mesh mesh = mesh_of("cloth-rest");
  const Positions exactly = positions("cloth-rest --level reference"), array = positions("cloth-rest");
  EXPECT_LT(imbalance(mesh, exactly, 20), 1e-10);
  EXPECT_LT(imbalance(mesh, array, 20), 1e-10);
  EXPECT_GT(imbalance(mesh, array, 1), 0.01) << "it took no steps to get there";
  for (std::size_t i = 0; i < mesh.nodes(); ++i) {
    const std::size_t mirrored = i - i % 12 + 11 - i % 12;
    EXPECT_NEAR(exactly.at(20, i, 2), exactly.at(20, mirrored, 2), 1e-9) << i;
    EXPECT_NEAR(exactly.at(20, i, 0) + exactly.at(20, mirrored, 0), 1.1, 1e-9) << i;
  }
  // Newton's way there, through time: steps so long that they damp every swing.
  const Positions newton =
      positions("cloth-rest --level backward_euler --set incremental.rule=backward_euler "
                "--set motion.time_step=0.5 --steps 60");
  EXPECT_LT(distance(array, newton, 20, 60), 1e-6);
}

TEST_F(SceneMotion, LevelsRestAtTheSameBits) {
  for (const char* line : {"net --steps 3", "cloth-rest --steps 4"}) expect_equal_levels(line);
}

} // namespace
} // namespace hopmesh::tests
