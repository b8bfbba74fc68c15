// The kernels of a force pass against each other, bit for bit, and against a loop that knows no rows.
#include "sim/rivals/force_pass.h"
#include "tests/rivals/rival_meshes.h"

#include <Eigen/Dense>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace hopmesh::tests {
namespace {

using namespace rivals;

/// Springs one by one, straight from the definition.
Vector plain_forces(const scene::Mesh& mesh, const Vector& x) {
  const Eigen::Index n = mesh.nodes();
  Vector f = Vector::Zero(3 * n);
  for (const scene::Spring& s : mesh.springs) {
    Eigen::Vector3d d;
    for (Eigen::Index p = 0; p < 3; ++p) d[p] = x[p * n + s.node[1]] - x[p * n + s.node[0]];
    const Eigen::Vector3d pull = 2 * s.weight * (d.norm() - s.rest_length) / d.norm() * d;
    for (Eigen::Index p = 0; p < 3; ++p) f[p * n + s.node[0]] += pull[p], f[p * n + s.node[1]] -= pull[p];
  }
  return f;
}

/// Rows of every kind: long and short ones, gaps, springs that stand alone.
scene::Mesh random_mesh(std::mt19937& random) {
  std::uniform_real_distribution<double> one(0, 1);
  scene::Mesh mesh;
  mesh.position.resize(20 + random() % 400);
  mesh.pinned.resize(mesh.nodes());
  for (auto& x : mesh.position) x = {one(random), one(random), one(random)};
  const double kept = one(random);
  for (const std::uint32_t apart : {1u, 2u, 3u, 7u, 8u, 9u, 19u})
    for (std::uint32_t i = 0; i + apart < mesh.nodes(); ++i)
      if (one(random) < kept) mesh.springs.push_back({{i, i + apart}, one(random), one(random)});
  mesh.springs.push_back({{0, std::uint32_t(mesh.nodes() - 1)}, 1, 0});
  return mesh;
}

Vector by_component(const scene::Mesh& mesh) {
  const Eigen::Index n = mesh.nodes();
  Vector x(3 * n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index p = 0; p < 3; ++p) x[p * n + i] = mesh.position[i][p];
  return x;
}

TEST(ForceKernel, everyKernelGivesTheBitsOfThePortableOneAndTheForcesOfTheDefinition) {
  const unsigned seed = std::random_device()();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (int k = 0; k < 100; ++k) {
    const scene::Mesh mesh = random_mesh(random);
    const Vector x = by_component(mesh), plain = plain_forces(mesh, x);
    Vector portable(x.size()), force(x.size());
    ForcePass(mesh.nodes(), mesh.springs, portable_kernel).forces(x, portable);
    EXPECT_LT((portable - plain).lpNorm<Eigen::Infinity>(), 1e-12 * (1 + plain.lpNorm<Eigen::Infinity>()));
    for (const ForceKernel& kernel : force_kernels()) {
      ForcePass(mesh.nodes(), mesh.springs, kernel).forces(x, force);
      EXPECT_EQ(force, portable) << kernel.name;
    }
  }
}

/// The stiffness of all springs, by nodes' components, from the definition.
Eigen::MatrixXd plain_stiffness(const scene::Mesh& mesh, const Vector& x) {
  const Eigen::Index n = mesh.nodes();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (const scene::Spring& s : mesh.springs) {
    Eigen::Vector3d d;
    for (Eigen::Index p = 0; p < 3; ++p) d[p] = x[p * n + s.node[1]] - x[p * n + s.node[0]];
    const double k = 2 * s.weight, clamped = std::min(1.0, s.rest_length / d.norm());
    for (Eigen::Index p = 0; p < 3; ++p)
      for (Eigen::Index q = 0; q < 3; ++q) {
        const double b = k * ((p == q ? 1 - clamped : 0) + clamped * d[p] * d[q] / d.squaredNorm());
        const Eigen::Index a = p * n, c = q * n;
        all(a + s.node[0], c + s.node[0]) += b, all(a + s.node[1], c + s.node[1]) += b;
        all(a + s.node[0], c + s.node[1]) -= b, all(a + s.node[1], c + s.node[0]) -= b;
      }
  }
  return all;
}

/// What a kernel makes of a mesh: the tangents of its springs, its diagonal blocks, its product with v.
struct Linearised {
  Vector tangents, diagonal, product;
};
Linearised linearised(const scene::Mesh& mesh, const ForceKernel& kernel, const Vector& x, const Vector& v) {
  const ForcePass pass(mesh.nodes(), mesh.springs, kernel);
  const Eigen::Index n = mesh.nodes(), springs = pass.springs();
  Linearised all{Vector::Zero(4 * springs), Vector::Zero(6 * n), Vector::Zero(3 * n)};
  pass.each_block([&](const Block& block, Eigen::Index first) {
    double* const at = all.tangents.data() + first;
    const Tangents tangents{at, at + springs, at + 2 * springs, at + 3 * springs};
    kernel.linearise(block, n, x.data(), tangents, all.diagonal.data());
    kernel.multiply(block, tangents, n, v.data(), all.product.data());
  });
  return all;
}

TEST(ForceKernel, everyKernelLinearisesAlikeAndAsTheDefinition) {
  const unsigned seed = std::random_device()();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (int k = 0; k < 30; ++k) {
    const scene::Mesh mesh = random_mesh(random);
    const Eigen::Index n = mesh.nodes();
    const Vector x = by_component(mesh), v = Vector::NullaryExpr(3 * n, [&] { return random() / 4e9 - 0.5; });
    const Eigen::MatrixXd plain = plain_stiffness(mesh, x);
    const Linearised portable = linearised(mesh, portable_kernel, x, v);
    EXPECT_LT((portable.product - plain * v).lpNorm<Eigen::Infinity>(), 1e-11);
    constexpr int row[] = {0, 1, 2, 0, 0, 1}, column[] = {0, 1, 2, 1, 2, 2};
    for (Eigen::Index c = 0; c < 6; ++c)
      for (Eigen::Index i = 0; i < n; ++i)
        ASSERT_NEAR(portable.diagonal[c * n + i], plain(row[c] * n + i, column[c] * n + i), 1e-11);
    for (const ForceKernel& kernel : force_kernels()) {
      const Linearised other = linearised(mesh, kernel, x, v);
      EXPECT_EQ(other.tangents, portable.tangents) << kernel.name;
      EXPECT_EQ(other.diagonal, portable.diagonal) << kernel.name;
      EXPECT_EQ(other.product, portable.product) << kernel.name;
    }
  }
}

TEST(ForceKernel, everyKernelKicksAlike) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> one(-1, 1);
  for (const Eigen::Index count : {1, 7, 8, 63, 1200}) {
    const auto some = [&] { return Vector(Vector::NullaryExpr(count, [&] { return one(random); })); };
    const Vector force = some(), mass = some(), external = some(), before = some();
    for (const ForceKernel& kernel : force_kernels()) {
      Vector v = before;
      kernel.kick(count, 0.75, 0.1, force.data(), mass.data(), external.data(), v.data());
      for (Eigen::Index k = 0; k < count; ++k)
        EXPECT_EQ(v[k], 0.75 * before[k] + 0.1 * (force[k] * mass[k] + external[k])) << kernel.name;
    }
  }
}

// A spring without rest length and without length pulls nowhere, and is no division by zero.
TEST(ForceKernel, aSpringOfNoLengthPullsNowhere) {
  scene::Mesh mesh;
  mesh.position.assign(40, {1, 2, 3});
  mesh.pinned.resize(40);
  for (std::uint32_t i = 0; i + 9 < 40; ++i) mesh.springs.push_back({{i, i + 9}, 1, 0.5});
  for (std::uint32_t i = 0; i + 1 < 40; ++i) mesh.springs.push_back({{i, i + 1}, 1, 0.5});
  const Vector x = by_component(mesh);
  Vector force(x.size());
  for (const ForceKernel& kernel : force_kernels()) {
    ForcePass(40, mesh.springs, kernel).forces(x, force);
    EXPECT_EQ(force, Vector::Zero(x.size())) << kernel.name;
  }
}

} // namespace
} // namespace hopmesh::tests
