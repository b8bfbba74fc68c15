// The uses of Neural Mesh (docs/findings/trees-surfaces-snakes.md): each shipped scene against its closed
// form, at every level.
#include "tests/support/cli_test.h"

#include "place.h"

#include <cmath>
#include <fstream>
#include <sstream>

namespace hopmesh::tests {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

using Place = std::array<double, 3>;

/// Where the nodes are after the last step.
std::vector<Place> last_places(const fs::path& results) {
  const Array array = read_array(results / "positions.npy");
  const std::size_t nodes = array.shape[1], first = array.values.size() - 3 * nodes;
  std::vector<Place> places(nodes);
  for (std::size_t k = 0; k < 3 * nodes; ++k) places[k / 3][k % 3] = array.values[first + k];
  return places;
}

/// Length of the `l` lines of a shipped OBJ with its nodes at these places.
double length_of(const std::string& scene, const std::vector<Place>& places) {
  std::ifstream obj(HOPMESH_SOURCE_DIR "/sim/scenes/" + scene + ".obj");
  double sum = 0;
  for (std::string line; std::getline(obj, line);) {
    std::istringstream words(line);
    std::string keyword;
    std::size_t from = 0, to = 0;
    if (!(words >> keyword) || keyword != "l") continue;
    for (words >> from; words >> to; from = to) {
      const Place &a = places[from - 1], &b = places[to - 1];
      sum += std::sqrt(std::pow(a[0] - b[0], 2) + std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2));
    }
  }
  return sum;
}

class CliNeuralMesh : public Cli {
 protected:
  /// The scene at the array's two levels, which must agree; the places they end at. The reference, asked
  /// beside them, must have built the same first network; a tree's last ones are made of rounding.
  std::vector<Place> at_rest(const std::string& scene) const {
    const fs::path engine = results_of(scene + " --check", "engine"),
                   systemc = results_of(scene + " --level systemc", "systemc");
    expect_same_bits(engine, systemc);
    EXPECT_LT(read_table(engine / "steps.csv").numbers("network_error").front(), 1e-9) << scene;
    return last_places(engine);
  }
  void expect_refused(const std::string& run, const std::string& found) const {
    refused("run --steps 1 --out r " + run, found);
    EXPECT_FALSE(fs::exists(at("r"))) << run;
  }
  std::vector<Place> in_double(const std::string& scene) const {
    return last_places(results_of(
        scene + " --level reference --set relax.threshold=1e-14 --set relax.max_sweeps=20000", "reference"));
  }
};

const double root3 = std::sqrt(3.0);

struct Tree {
  std::string scene;
  double optimum;
};
// 3-4-5: half the squares of the sides and 2 sqrt 3 times the area. Ladder: Chung and Graham 1978, held
// against a search of its own in tests/reference/test_tension.cpp.
const std::vector<Tree> trees = {{"steiner-3", std::sqrt(25 + 12 * root3)},
                                 {"steiner-4", 1 + root3},
                                 {"steiner-6", std::sqrt(std::pow(3 * (1 + root3 / 2) - 1, 2) + 0.25)}};

TEST_F(CliNeuralMesh, TreesAreTheShortest) {
  for (const Tree& tree : trees) {
    EXPECT_NEAR(length_of(tree.scene, in_double(tree.scene)), tree.optimum, 1e-5 * tree.optimum)
        << tree.scene;
    const double length = length_of(tree.scene, at_rest(tree.scene));
    EXPECT_NEAR(length, tree.optimum, 0.01 * tree.optimum) << tree.scene;
    EXPECT_GE(length, tree.optimum * (1 - 1e-9)) << tree.scene << " is shorter than the shortest";
    fs::remove_all(at("engine")), fs::remove_all(at("systemc")), fs::remove_all(at("reference"));
  }
}

TEST_F(CliNeuralMesh, LinearSpringsGiveTheCentroidInstead) {
  const auto places = in_double("steiner-3 --set mesh.springs.law=linear --set mesh.rest=0");
  EXPECT_NEAR(places[3][0], 4.0 / 3, 1e-9);
  EXPECT_NEAR(places[3][2], 1, 1e-9);
}

double radius(const Place& p) {
  return std::sqrt(p[0] * p[0] + p[1] * p[1]);
}

TEST_F(CliNeuralMesh, TheNetBetweenTwoLoopsIsTheCatenoid) {
  for (const Place& p : in_double("catenoid")) EXPECT_NEAR(radius(p), std::cosh(p[2]), 1e-9);
  for (const Place& p : at_rest("catenoid")) EXPECT_NEAR(radius(p), std::cosh(p[2]), 0.01 * std::cosh(p[2]));
}

/// A tube like the shipped one with another number of rings between the same loops.
std::string tube(int rings, double height, double wide) {
  const int n = 32;
  std::ostringstream obj;
  obj.precision(17);
  for (int r = 0; r < rings; ++r)
    for (int k = 0; k < n; ++k)
      obj << "v " << wide * std::cos(2 * M_PI * k / n) << ' ' << wide * std::sin(2 * M_PI * k / n) << ' '
          << height * (2.0 * r / (rings - 1) - 1) << '\n';
  for (int r = 0; r + 1 < rings; ++r)
    for (int k = 0; k < n; ++k)
      obj << "f " << r * n + k + 1 << ' ' << r * n + (k + 1) % n + 1 << ' ' << (r + 1) * n + (k + 1) % n + 1
          << ' ' << (r + 1) * n + k + 1 << '\n';
  return obj.str();
}

// Half as many rings between the same loops: cosh(k), k = acosh(2 - cos(2 pi / 32)), in two steps instead of
// four.
TEST_F(CliNeuralMesh, ANetThatIsNoConformalOneIsAnotherSurface) {
  const double k = std::acosh(2 - std::cos(2 * M_PI / 32)), height = 4 * k, wide = std::cosh(height);
  write_text(at("tube.obj"), tube(5, height, wide));
  const auto places = in_double("catenoid --set mesh.file=tube.obj");
  for (const Place& p : places) {
    const double ring = 2 * p[2] / height;
    EXPECT_NEAR(radius(p), wide / std::cosh(2 * k) * std::cosh(k * ring), 1e-9);
  }
  EXPECT_NEAR(radius(places[2 * 32]), 1.2272, 1e-4) << "where the catenoid has 1";
}

double from_middle_of_disc(const Place& p) {
  return std::sqrt(std::pow(p[0] - 34, 2) + std::pow(p[2] + 29, 2));
}

TEST_F(CliNeuralMesh, TheSnakeLiesOnTheDiscsEdge) {
  const auto places = at_rest("snake");
  for (const auto& found : {places, in_double("snake")})
    for (const Place& p : found) EXPECT_NEAR(from_middle_of_disc(p), 17, 1);
  const std::string overlay = content_of(at("engine") / "overlay.svg");
  EXPECT_THAT(overlay, HasSubstr("data:image/png;base64,iVBORw0KGgo"));
  EXPECT_THAT(overlay, HasSubstr("<path d=\"M60.000 32.000L")) << "where node 0 started";
  EXPECT_FALSE(fs::exists(results_of("two-nodes --steps 2", "engine") / "overlay.svg")) << "of another run";
}

/// Twice the area between a node and the next of the ring around it, as its hub sees them: above 0 where the
/// net has not folded.
double area(const Place& hub, const Place& a, const Place& b) {
  return (a[0] - hub[0]) * (b[2] - hub[2]) - (b[0] - hub[0]) * (a[2] - hub[2]);
}

// A hub and three rings of 32 nodes (sim/scenes/snake-mesh.obj).
TEST_F(CliNeuralMesh, TheMeshedSnakesOuterRingLiesOnTheDiscsEdge) {
  const std::size_t n = 32;
  for (const auto& net : {at_rest("snake-mesh"), in_double("snake-mesh")}) {
    ASSERT_EQ(net.size(), 1 + 3 * n);
    for (std::size_t k = 0; k < n; ++k) {
      EXPECT_NEAR(from_middle_of_disc(net[1 + 2 * n + k]), 17, 1) << k;
      for (std::size_t ring = 0; ring < 3; ++ring)
        EXPECT_GT(area(net[0], net[1 + ring * n + k], net[1 + ring * n + (k + 1) % n]), 0)
            << ring << ' ' << k;
      EXPECT_LT(from_middle_of_disc(net[1 + n + k]), 13) << "the edge holds the outer ring alone";
    }
  }
  EXPECT_THAT(content_of(at("engine") / "overlay.svg"), HasSubstr("data:image/png;base64,iVBORw0KGgo"));
}

// The pictures of the page are what its commands leave.
TEST_F(CliNeuralMesh, ThePagesPicturesAreTheProgramsOwn) {
  const std::string pictures = HOPMESH_SOURCE_DIR "/docs/pictures/";
  for (const auto& [scene, file] : {std::pair{"steiner-6", "picture.svg"},
                                    {"catenoid", "picture.svg"},
                                    {"snake", "overlay.svg"},
                                    {"snake-mesh", "overlay.svg"}})
    EXPECT_TRUE(content_of(results_of(scene, scene) / file) == content_of(pictures + scene + ".svg"))
        << scene;
}

TEST_F(CliNeuralMesh, WhatIsNoImageIsRefusedInOneLine) {
  write_text(at("words.pgm"), "these are words");
  write_text(at("short.pgm"), "P5 4 4 255 abc");
  write_text(at("flat.pgm"), "P2 2 2 9 5 5 5 5");
  write_text(at("broken.png"), "\x89PNG\r\n\x1a\n and no more");
  const std::pair<const char*, const char*> all[] = {
      {"words.pgm", "found no picture in"},
      {"short.pgm", "found a PGM picture that ends early in"},
      {"flat.pgm", "found one shade of grey in"},
      {"broken.png", "found a PNG picture that libpng refuses"},
      {"none.png", "none.png"}};
  for (const auto& [file, found] : all)
    expect_refused(std::string("snake --set force.image.file=") + file, found);
}

TEST_F(CliNeuralMesh, RivalsAndTruthRefuseWhatTheyDoNotKnow) {
  const std::pair<const char*, const char*> all[] = {
      {"catenoid", "incremental.rule: found \"static\""},
      {"steiner-3 --set incremental.rule=bdf2", "mesh.springs.law: found \"tension\""},
      {"snake --set motion.friction=0.5", "force.image.file: found an image"}};
  for (const auto& [scene, found] : all) expect_refused(std::string("--level rk4 ") + scene, found);
}

} // namespace
} // namespace hopmesh::tests
