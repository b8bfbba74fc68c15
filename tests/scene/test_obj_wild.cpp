// OBJ files as other programs write them: each reads as it was meant, and what is left out is told.
#include "tests/scene/scene_makers.h"

#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using namespace scene;

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\n";

using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
const Edges rim{{0, 1}, {0, 3}, {1, 2}, {2, 3}};

Edges found_edges(const Mesh& mesh) {
  Edges all;
  for (const Spring& s : mesh.springs) all.emplace_back(s.node[0], s.node[1]);
  return all;
}

/// With keys of the mesh as they stand in a scene file.
Mesh mesh_with(const std::string& obj, const std::string& keys) {
  const Folder temp;
  temp.write("m.obj", obj);
  return build_mesh(read_inputs(temp.write("s.toml", "[mesh]\nfile = \"m.obj\"\n" + keys), "", {}).scene);
}

void expect_square(const std::string& text) {
  const Mesh mesh = mesh_of_obj(text);
  EXPECT_THAT(mesh.position,
              ElementsAre(Vector3{0, 0, 0}, Vector3{1, 0, 0}, Vector3{1, 0, 1}, Vector3{0, 0, 1}))
      << text;
  EXPECT_EQ(found_edges(mesh), rim) << text;
  EXPECT_THAT(mesh.notes, IsEmpty()) << text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

TEST(ObjWild, LinesOfAnySystemAndAByteOrderMark) {
  const std::string whole = square + "f 1 2 3 4\n";
  expect_square("\xEF\xBB\xBF" + whole);
  expect_square(replaced(whole, "\n", "\r"));
  expect_square(replaced(whole, "\n", "\r\n"));
  expect_square(replaced(whole, " ", " \t\f"));
  expect_square("\xEF\xBB\xBFl 1 2\nl 2 3\nl 3 4\nl 4 1\n" + square);
}

TEST(ObjWild, AStatementOfNumbersGoesOnBehindABackslash) {
  expect_square(square + "f 1 2 \\\n3 4\n");
  expect_square(square + "f \\\r\n1\\\r\n2 \\ \r\n3 4");
  expect_square("v 0 0 \\\n0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nl 1 \\\n 2 3 \\\n 4 1\n");
  expect_square(square + "vn 0 \\\n 1 0\nf 1 2 3 4 \\\n");
}

// A path or a comment may end in a backslash of its own: the line behind it is not theirs.
TEST(ObjWild, ABackslashOfANameTakesNoLineAlong) {
  expect_square(
      "# made in C:\\meshes\\\nv 0 0 0 # C:\\\nv 1 0 0\nv 1 0 1\nv 0 0 1\nmtllib C:\\\nf 1 2 3 4\n");
  expect_square("usemtl a\\\nv 0 0 0\ng b\\\nv 1 0 0\no c\\\nv 1 0 1\nv 0 0 1\nf 1 2 3 4\n");
}

TEST(ObjWild, ACommentBeginsWhereAWordMay) {
  expect_square("#\n\t# f 1 2 3\n" + replaced(square, "\n", " # \xC3\xA9 v 7\n") + "f 1 2 3 4 #f 1 3 2\n");
}

TEST(ObjWild, WeightsColoursAndEveryFormOfNumber) {
  expect_square(
      "v 0 0 0 1\nv +1 1e-400 -0.0 1.0\nv 1.0E+0 0 1.D0 0.1 0.2 nan\nv .0e-3 0 1. 1 1 1 1\nf +1 2 3 4\n");
}

TEST(ObjWild, NamesGroupsAndLooksAreSilent) {
  expect_square("mtllib \xC3\xBC.mtl\no \xE7\x89\x9B\ng a b\ns off\nusemtl x\nlod 1\n" + square +
                "vn nan nan nan\nf 1//1 2//1 3// 4\n");
}

TEST(ObjWild, AVeryLongLine) {
  std::string line = "l 1 2 3 4 1";
  for (int k = 0; k < 50'000; ++k) line += " 2 3 4 1";
  expect_square(square + line + '\n');
}

TEST(ObjWild, WhatIsPassedOverIsNamed) {
  const Mesh mesh = mesh_of_obj(square + "p 1\np 2\ncurv 0 1 1 \\\n2\nf 1 2 3 4\n\x01 7\n");
  EXPECT_EQ(found_edges(mesh), rim);
  EXPECT_THAT(
      mesh.notes,
      ElementsAre(EndsWith("mesh.obj: passed over statements that add neither vertex, face nor line: "
                           "\"\\x01\" (1 time, first in line 10), \"curv\" (1 time, first in line 7), \"p\" "
                           "(2 times, first in line 5)")));
}

TEST(ObjWild, TextureCornersThatAreNoNumbersAreNoReasonToRefuseAMesh) {
  const Mesh mesh = mesh_of_obj(square + "vt nan inf\nvt 0.5 1\nf 1/1 2/2 3/2 4/2\n");
  EXPECT_THAT(mesh.notes, ElementsAre(EndsWith("1 texture corner is no number within 1e15, taken as 0 0")));
  EXPECT_EQ(mesh.triangles[0][0].u, 0);
  EXPECT_EQ(mesh.triangles[0][1].u, 0.5f);
}

TEST(ObjWild, RepeatedCornersAreOne) {
  for (const char* face : {"f 1 2 3 4 1\n", "f 1 1 2 3 3 3 4\n", "f 1 2 3 4 4 1 1\n", "l 1 2 2 3 4 1\n"}) {
    const Mesh mesh = mesh_of_obj(square + face);
    EXPECT_EQ(found_edges(mesh), rim) << face;
    EXPECT_THAT(mesh.notes, ElementsAre(HasSubstr("left out that repeat the one before"))) << face;
  }
}

TEST(ObjWild, FacesOfFewerThanThreeCornersAreLeftOut) {
  const Mesh mesh = mesh_of_obj(square + "f 1 1 3\nf 1 3 1 3\nf 1 2 3 4\nl 2 2\n");
  EXPECT_EQ(found_edges(mesh), rim);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_THAT(mesh.notes,
              ElementsAre(HasSubstr("9 corners left out that repeat the one before, with them 2 faces of "
                                    "fewer than three different corners and 1 line of a single point")));
}

TEST(ObjWild, APolygonThatComesByAVertexTwiceHasNoTriangleWithoutArea) {
  const Mesh mesh = mesh_of_obj(square + "v 2 0 2\nf 1 2 3 5 3 4\n");
  EXPECT_EQ(found_edges(mesh).size(), 5u);
  for (const auto& t : mesh.triangles) EXPECT_TRUE(t[0].node != t[1].node && t[0].node != t[2].node);
}

TEST(ObjWild, LooseVerticesAreLeftOutOrKeptAsPinnedNodes) {
  const std::string obj = "v 9 9 9\n" + square + "v 7 7 7\nf 2 3 4 5\n";
  const Mesh dropped = mesh_with(obj, "");
  EXPECT_EQ(dropped.nodes(), 4u);
  EXPECT_EQ(found_edges(dropped), rim);
  EXPECT_THAT(dropped.notes,
              ElementsAre(HasSubstr("m.obj: 2 vertices in no face or line, the first in line 1: left "
                                    "out, so later nodes have lower numbers than in the file")));
  const Mesh kept = mesh_with(obj, "loose = \"keep\"\npinned = [1]\n");
  EXPECT_EQ(kept.nodes(), 6u);
  EXPECT_EQ(found_edges(kept)[0], std::pair(1u, 2u)) << "a node's number is the vertex's less 1";
  EXPECT_EQ(kept.pinned, (std::vector<bool>{true, true, false, false, false, true}));
  EXPECT_THAT(kept.notes, ElementsAre(EndsWith("the first in line 1: kept, pinned where they stand")));
}

// Two triangles side by side, as programs write them that split vertices along the seams of a picture.
const std::string split_square = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3\nf 4 5 6\n";

TEST(ObjWild, PartsAndSeamsAreToldInALine) {
  const Mesh mesh = mesh_with(split_square, "pinned = [0]\n");
  EXPECT_EQ(mesh.nodes(), 6u);
  EXPECT_THAT(mesh.notes,
              ElementsAre(EndsWith("m.obj: 2 parts that no spring joins, 1 of them without a pin; 2 nodes "
                                   "at a place where another one stands, not joined to it: seams that "
                                   "open (mesh.weld = true joins them)")));
}

TEST(ObjWild, WeldingJoinsSeams) {
  const Mesh mesh = mesh_with(split_square, "weld = true\n");
  EXPECT_EQ(found_edges(mesh), (Edges{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}}));
  EXPECT_THAT(mesh.notes, ElementsAre(EndsWith("2 vertices welded to others at the same place")));
}

TEST(ObjWild, WeldingMakesAnEdgeWithoutLengthOneNode) {
  const std::string obj = square + "v 0 0 1\nf 1 2 3 4 5\n";
  EXPECT_THAT(complaint([&] { mesh_of_obj(obj); }), HasSubstr("or mesh.weld = true"));
  EXPECT_EQ(found_edges(mesh_with(obj, "weld = true\n")), rim);
}

TEST(ObjWild, ASpringFarShorterThanTheOthersIsNamed) {
  const Mesh mesh = mesh_of_obj("v 0 0 0\nv 1e-12 0 0\nv 1 0 0\nv 1 0 1\nf 1 2 3 4\n");
  EXPECT_THAT(mesh.notes, ElementsAre(HasSubstr("the spring of nodes 0 and 1 is 1e-12 m long")));
}

TEST(ObjWild, ShippedMeshesHaveNothingToTell) {
  for (const char* name :
       {"catenoid", "snake", "snake-mesh", "soft-block", "steiner-3", "steiner-4", "steiner-6", "tablecloth"})
    EXPECT_THAT(build_mesh(read_inputs(name, "", {}).scene).notes, IsEmpty()) << name;
}

} // namespace
} // namespace hopmesh::tests
