// A checkpoint keeps every bit, and none of its bytes can change unseen.
#include "sim/run/checkpoint.h"
#include "tests/support/complaint.h"
#include "tests/support/files.h"

#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <limits>
#include <random>

namespace hopmesh::tests {
namespace {

using run::Checkpoint;
using ::testing::HasSubstr;
using tests::content_of;
namespace fs = std::filesystem;

class CheckpointFile : public ::testing::Test {
 protected:
  CheckpointFile() {
    c.program = run::this_program();
    c.level = "systemc";
    c.command = "hopmesh run 'two\nlines and a \\ there'";
    c.check = true;
    c.every = 40, c.asked = 123;
    c.wall_seconds = 0.1;
    c.mesh = 0x0123456789abcdef;
    c.image = 0xf0e1d2c3b4a59687;
    c.scene = "name = \"x\"\n\n[mesh]\n";
    c.array = "name = \"y\"\n";
    c.ranges = {{"weight", {}, -7, 9}, {"state", {}, std::numeric_limits<std::int64_t>::min(), 0}};
    c.streams = {{"positions.npy", {1234, 0xfedcba9876543210}}, {"steps.csv", {0, 1}}};
    c.state = {5,     {0.1, -0.0, 1e-320}, {1 / 3.0, INFINITY, 3}, {4, 5, std::nan("7")}, {-1, 2}, {7, 8, 9},
               {0.5}, {-14, 0.25}};
  }
  Checkpoint again() const {
    run::write_checkpoint(file, c);
    return run::read_checkpoint(file);
  }
  void put(const std::string& bytes) const {
    fs::remove(file); // some disks flush a file that is emptied and written again
    write_text(file, bytes);
  }
  /// What the reader says to these bytes; "" if it takes them.
  std::string refusal(const std::string& bytes) const {
    put(bytes);
    return complaint([&] { run::read_checkpoint(file); });
  }
  std::string whole() const {
    run::write_checkpoint(file, c);
    return content_of(file);
  }

  Checkpoint c;
  const Folder folder;
  const fs::path file = folder / "checkpoint";
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST_F(CheckpointFile, ReadsBackToTheSameBits) {
  const Checkpoint d = again();
  EXPECT_EQ(d.command, c.command);
  EXPECT_EQ(d.level, c.level);
  EXPECT_EQ(d.scene, c.scene);
  EXPECT_EQ(d.array, c.array);
  EXPECT_TRUE(d.check);
  EXPECT_EQ(d.every, 40u);
  EXPECT_EQ(d.asked, 123u);
  EXPECT_EQ(d.wall_seconds, 0.1);
  EXPECT_EQ(d.mesh, c.mesh);
  EXPECT_EQ(d.image, c.image);
  ASSERT_EQ(d.ranges.size(), 2u);
  EXPECT_EQ(d.ranges[1].signal, "state");
  EXPECT_EQ(d.ranges[1].least, c.ranges[1].least);
  EXPECT_EQ(d.ranges[0].largest, 9);
  ASSERT_EQ(d.streams.size(), 2u);
  EXPECT_EQ(d.streams[0].name, "positions.npy");
  EXPECT_EQ(d.streams[0].mark.bytes, 1234u);
  EXPECT_EQ(d.streams[0].mark.check, c.streams[0].mark.check);
  EXPECT_EQ(d.state.step, 5u);
  EXPECT_TRUE(same_bits(d.state.position, c.state.position));
  EXPECT_TRUE(same_bits(d.state.velocity, c.state.velocity));
  EXPECT_TRUE(same_bits(d.state.acceleration, c.state.acceleration));
  EXPECT_TRUE(same_bits(d.state.output, c.state.output));
}

TEST_F(CheckpointFile, AMeshAloneHasNoLineOfAnImage) {
  c.image.reset();
  EXPECT_EQ(whole().find(" image "), std::string::npos);
  EXPECT_EQ(again().image, std::nullopt);
}

TEST_F(CheckpointFile, NoByteCanChangeUnseen) {
  const std::uint64_t seed = std::random_device()();
  std::printf("seed %lu\n", seed);
  std::mt19937_64 random(seed);
  const std::string good = whole(), place = file.string() + ":";
  for (std::size_t k = 0; k < good.size(); ++k) {
    std::string bad = good;
    bad[k] = static_cast<char>(bad[k] ^ (1 + random() % 255));
    EXPECT_THAT(refusal(bad), HasSubstr(place)) << "byte " << k;
  }
  EXPECT_EQ(refusal(good), "");
}

TEST_F(CheckpointFile, ADamagedLineIsNamed) {
  const std::string good = whole();
  int line = 1;
  for (std::size_t k = 0; k < good.find("binary"); ++k) {
    std::string bad = good;
    bad[k] ^= 1;
    if (good[k] != '\n') {
      EXPECT_THAT(refusal(bad), HasSubstr(file.string() + ':' + std::to_string(line) + ": "));
    }
    line += good[k] == '\n';
  }
}

TEST_F(CheckpointFile, NothingMayBeMissingOrTooMuch) {
  const std::string good = whole();
  for (std::size_t k = 0; k < good.size(); ++k)
    EXPECT_THAT(refusal(good.substr(0, k)), HasSubstr(file.string())) << k;
  EXPECT_THAT(refusal(good + "x"), HasSubstr("binary: found 137 bytes behind this line, expected 136"));
}

TEST_F(CheckpointFile, LinesOfAnotherCheckpointDoNotMixIn) {
  const std::string good = whole();
  c.every = 41;
  const std::string other = whole();
  const std::size_t at = good.find(" wall_seconds") - 16; // behind it both say the same
  EXPECT_EQ(good.substr(0, 50), other.substr(0, 50));
  EXPECT_THAT(refusal(good.substr(0, at) + other.substr(at)),
              HasSubstr("checkpoint:8: found a damaged line"));
}

TEST_F(CheckpointFile, AnotherProgramsIsRefused) {
  c.program = "0.0.1 0123456789ab";
  EXPECT_THAT(refusal(whole()), HasSubstr("checkpoint:2: program: found \"0.0.1 0123456789ab\", expected \"" +
                                          run::this_program() + '"'));
}

TEST_F(CheckpointFile, FilesOfOtherKindsAreNoDamagedCheckpoints) {
  EXPECT_THAT(refusal("name = \"flag\"\n"), HasSubstr("checkpoint:1: found \"name = "));
  EXPECT_THAT(refusal(std::string(5000, '\0')), HasSubstr("expected a checkpoint of hopmesh"));
  EXPECT_THAT(refusal(""), HasSubstr("expected a checkpoint of hopmesh"));
}

TEST(MeshHash, SeesEveryPartOfAMesh) {
  scene::Mesh mesh;
  mesh.position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  mesh.springs = {{{0, 1}, 1, 1}};
  mesh.pinned = {true, false, false};
  mesh.triangles = {{{{0, 0, 0}, {1, 0, 1}, {2, 1, 1}}}};
  const std::uint64_t hash = run::mesh_hash(mesh);
  const std::vector<void (*)(scene::Mesh&)> changes{
      [](scene::Mesh& m) { m.position[2][1] = 1.0000000000000002; },
      [](scene::Mesh& m) { m.springs[0].rest_length = 2; },
      [](scene::Mesh& m) { m.pinned[1] = true; },
      [](scene::Mesh& m) { m.mass = 2; },
      [](scene::Mesh& m) { m.planar = true; },
      [](scene::Mesh& m) { m.triangles[0][1].v = 0.5f; }};
  EXPECT_EQ(run::mesh_hash(mesh), hash);
  for (const auto& change : changes) {
    scene::Mesh other = mesh;
    change(other);
    EXPECT_NE(run::mesh_hash(other), hash);
  }
}

} // namespace
} // namespace hopmesh::tests
