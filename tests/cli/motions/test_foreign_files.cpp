// Meshes and pictures as other programs write them, through the program: the right motion, or one clear line.
#include "tests/support/cli_test.h"

#include <cmath>
#include <cstdlib>
#include <map>

#include "place.h"

namespace hopmesh::tests {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ForeignFiles : public Cli {
 protected:
  /// A scene of the mesh file m.obj that falls for three steps.
  void write_scene(const std::string& keys = "") const {
    write_text(at("s.toml"), "[mesh]\nfile = \"m.obj\"\npinned = [0]\n" + keys +
                                 "\n[motion]\nformulation = \"incremental\"\ntime_step = 0.01\nsteps = 3\n"
                                 "[force]\ngravity = [0.0, 0.0, -9.81]\n");
  }

  Finished run_obj(const std::string& obj) const {
    write_text(at("m.obj"), obj);
    return good("run s.toml --out out");
  }

  std::vector<double> places() const { return read_array(at("out/positions.npy")).values; }
};

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 0 -1\nv 0 0 -1\n";

TEST_F(ForeignFiles, OneMeshHoweverItIsWrittenIsOneMotion) {
  write_scene();
  run_obj(square + "f 1 2 3 4\n");
  const std::vector<double> expected = places();
  for (const std::string& text : {"\xEF\xBB\xBF" + square + "f 1 2 3 4\n", square + "f 1 2 \\\n3 4\n",
                                  square + "f 1 2 3 4 1\n", square + "l 1 2\nl 2 3\nl 3 4\nl 4 1\n",
                                  square + "v 9 9 9\nf 1 2 3 4\n", square + "p 1\nf -4 -3 -2 -1\n",
                                  std::string("v 0 0 1e-400 1\rv 1 0 0\rv 1 0 -1\rv 0 0 -1\rf 1 2 3 4")}) {
    run_obj(text);
    EXPECT_EQ(places(), expected) << text;
  }
}

TEST_F(ForeignFiles, WhatIsLeftOutIsTold) {
  write_scene();
  EXPECT_EQ(run_obj(square + "f 1 2 3 4\n").err, "");
  EXPECT_THAT(run_obj(square + "v 9 9 9\nf 1 2 3 4\n").err,
              AllOf(HasSubstr("hopmesh: note: "), HasSubstr("m.obj: 1 vertex in no face or line")));
  EXPECT_THAT(run_obj(square + "v 5 0 0\nv 6 0 0\nv 6 0 -1\nf 1 2 3 4\nf 5 6 7\n").err,
              HasSubstr("m.obj: 2 parts that no spring joins, 1 of them without a pin\n"));
}

TEST_F(ForeignFiles, WhatIsBrokenIsRefused) {
  write_scene();
  for (const auto& [text, says] : std::vector<std::pair<std::string, std::string>>{
           {"v 0 0 0\nv 1 0 0\nv 1 0 -1.#IND00\nf 1 2 3\n",
            "m.obj:3: found \"-1.#IND00\", expected a number for z"},
           {"v 0 0 0 abc\nv 1 0 0\nv 1 0 -1\nf 1 2 3\n", "m.obj:1: found \"abc\""},
           {"ply\nformat ascii 1.0\n", "m.obj: found a PLY file, expected an OBJ mesh"}}) {
    write_text(at("m.obj"), text);
    refused("run s.toml --out out", says);
  }
}

// A sheet of 0.4 m in map coordinates: single precision would leave 10 of its 25 places.
TEST_F(ForeignFiles, AMeshFarFromTheOriginIsDrawnAboutItsMiddle) {
  std::string obj, near;
  for (int r = 0; r < 5; ++r)
    for (int c = 0; c < 5; ++c) {
      obj += "v 500000." + std::to_string(c + 1) + " 4600000." + std::to_string(r + 2) + " 300.5\n";
      near += "v 0." + std::to_string(c) + " 0." + std::to_string(r) + " 0\n";
    }
  std::string faces;
  for (int r = 0; r < 4; ++r)
    for (int k = 5 * r + 1; k < 5 * r + 5; ++k)
      faces += "f " + std::to_string(k) + ' ' + std::to_string(k + 1) + ' ' + std::to_string(k + 6) + ' ' +
               std::to_string(k + 5) + '\n';
  write_scene();
  EXPECT_THAT(run_obj(obj + faces).out, HasSubstr("(500000.3, 4600000.4, 300.5) m"));
  const std::string far_glb = content_of(at("out/mesh.glb")), far_picture = content_of(at("out/picture.svg"));
  EXPECT_THAT(far_glb, HasSubstr("\"translation\":[500000.3,300.5,-4600000.4"));
  EXPECT_THAT(run_obj(near + faces).out, Not(HasSubstr("pictures' origin")));
  EXPECT_THAT(content_of(at("out/mesh.glb")), Not(HasSubstr("translation")));
  EXPECT_EQ(far_picture.substr(0, 120), content_of(at("out/picture.svg")).substr(0, 120))
      << "a paper of the same size";
}

// A ring that nothing holds draws itself together: its energy may only fall, to a point's.
TEST_F(ForeignFiles, ARingOfConstantTensionCollapsesAndStays) {
  constexpr int nodes = 24;
  std::string obj, line = "l";
  for (int k = 0; k < nodes; ++k) {
    const double angle = 2 * std::acos(-1) * k / nodes;
    obj += "v " + std::to_string(5 * std::cos(angle)) + " 0 " + std::to_string(5 * std::sin(angle)) + '\n';
    line += ' ' + std::to_string(k + 1);
  }
  write_text(at("ring.obj"), obj + line + " 1\n");
  write_text(at("ring.toml"),
             "[mesh]\nfile = \"ring.obj\"\nsprings = { law = \"tension\" }\nplanar = true\n[motion]\n"
             "formulation = \"incremental\"\ntime_step = 1.0\nsteps = 120\nfriction = 0.0\n");
  for (const std::string level : {"reference", "engine"})
    for (const std::string rule : {"backward_euler", "bdf2"}) {
      good("run ring.toml --no-check --level " + level + " --set incremental.rule=" + rule + " --out " +
           level);
      const std::vector<double> energy = read_table(at(level + "/steps.csv")).numbers("energy");
      ASSERT_EQ(energy.size(), 120u) << level << ' ' << rule;
      for (std::size_t k = 1; k < energy.size() && rule == "backward_euler"; ++k) {
        ASSERT_LE(energy[k], energy[k - 1] * (1 + 1e-9)) << level << ", step " << k;
      }
      EXPECT_LT(energy.back(), 0.25) << level << ' ' << rule;
    }
}

/// A mesh of a collection, or a skipped test where it is absent.
std::string mesh_elsewhere(const std::string& name) {
  const char* told = std::getenv("HOPMESH_MESHES");
  const std::filesystem::path file = std::filesystem::path(told ? told : HOPMESH_MESHES) / name;
  return std::filesystem::exists(file) ? file.string() : "";
}

class MeshesOfOthers : public Cli, public ::testing::WithParamInterface<const char*> {};

TEST_P(MeshesOfOthers, Run) {
  const std::string file = mesh_elsewhere(GetParam());
  if (file.empty()) GTEST_SKIP() << "no " << GetParam() << " in HOPMESH_MESHES";
  write_text(at("s.toml"), "[mesh]\nfile = \"" + file +
                               "\"\nup = \"y\"\npinned = \"top\"\nmass = 0.001\n[motion]\n"
                               "formulation = \"incremental\"\ntime_step = 0.001\nsteps = 3\n"
                               "[force]\ngravity = [0.0, -9.81, 0.0]\n");
  const Finished f = good("run s.toml --out out");
  EXPECT_THAT(f.out, HasSubstr("All 3 steps done"));
  static const std::map<std::string, std::string> told{
      {"stanford-bunny.obj", "1,113 vertices in no face or line"},
      {"teapot.obj", "4 parts that no spring joins"},
      {"suzanne.obj", "3 parts that no spring joins"},
      {"spot.obj", ""}};
  EXPECT_THAT(f.err, HasSubstr(told.at(GetParam())));
}

INSTANTIATE_TEST_SUITE_P(OfTheCollection, MeshesOfOthers,
                         ::testing::Values("stanford-bunny.obj", "teapot.obj", "suzanne.obj", "spot.obj"));

} // namespace
} // namespace hopmesh::tests
