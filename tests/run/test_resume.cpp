// A motion that is given its state back, and a run that goes on from its folder, equal the unbroken one.
#include "sim/levels/level.h"
#include "sim/run/checkpointer.h"
#include "sim/run/step_table.h"
#include "tests/support/complaint.h"
#include "tests/support/files.h"
#include "tests/support/small_scenes.h"
#include "tests/support/soft_array.h"

#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;
using tests::content_of;
namespace fs = std::filesystem;

scene::Scene short_scene() {
  scene::Scene scene = grid_scene(2, 3);
  scene.motion.steps = 6;
  return scene;
}

/// A level's motion of the scene, as a run has it.
struct Rig {
  explicit Rig(const std::string& name) : Rig(levels::level_named(name, "")) {}
  explicit Rig(const levels::Level& level)
      : prepared{{short_scene(), fine_array()}, std::make_unique<levels::BuiltMesh>(short_scene())},
        ready(levels::make_ready(level, prepared, true)), mesh(*prepared.mesh),
        motion(ready.mover.get()), facts{prepared.inputs, &level, "hopmesh run grid", 0, level.has_codes()} {}
  levels::Prepared prepared;
  levels::ReadyLevel ready;
  const levels::BuiltMesh& mesh;
  levels::Mover* motion;
  run::RunFacts facts;
};

class Resume : public ::testing::TestWithParam<const char*> {
 protected:
  /// The first steps of a run, saved after each; then its process is gone.
  void begin(std::uint64_t steps) const {
    Rig rig(GetParam());
    run::RunFiles files(out, rig.facts, rig.mesh, *rig.motion);
    run::Checkpointer safe(files, 1, 0, [](std::uint64_t) {});
    run::simulate(*rig.motion, steps, {&files, &safe}, stop);
    if (steps == 0) safe.save(*rig.motion);
  }
  /// The next ones, from what is in the folder.
  void go_on(std::uint64_t steps) const {
    run::ResumedRun found = run::read_run(out);
    Rig rig(GetParam());
    rig.motion->restore(found.saved.state, found.saved.ranges);
    run::RunFiles files(out, rig.facts, rig.mesh, std::move(found.streams));
    run::Checkpointer safe(files, 1, 0, [](std::uint64_t) {});
    run::RunResult earlier;
    earlier.rows = found.rows;
    const auto result = run::simulate(*rig.motion, steps, {&files, &safe}, stop, earlier);
    if (steps == 6) files.finish(result, *rig.motion);
  }
  std::string refusal() const {
    return complaint([&] { run::read_run(out); });
  }

  const Folder folder;
  const fs::path out = folder / "r";
  std::atomic<bool> stop{false};
};

// A level of each kind; bdf2 looks two steps back. tests/cli/motions/test_resume.cpp tries every level.
INSTANTIATE_TEST_SUITE_P(Of, Resume, ::testing::Values("engine", "reference", "bdf2"),
                         [](const auto& made) { return made.param; });

TEST_P(Resume, AMotionGoesOnFromItsState) {
  Rig unbroken(GetParam()), first(GetParam()), second(GetParam());
  for (int k = 0; k < 3; ++k) unbroken.motion->advance(), first.motion->advance();
  second.motion->restore(first.motion->state(), first.motion->ranges());
  for (int k = 0; k < 3; ++k) {
    const levels::StepRow a = unbroken.motion->advance(), b = second.motion->advance();
    EXPECT_EQ(a.hash, b.hash);
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.time, b.time);
    EXPECT_EQ(a.cycles, b.cycles);
    EXPECT_EQ(a.bus_cycles, b.bus_cycles);
  }
  const auto a = unbroken.motion->ranges(), b = second.motion->ranges();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].least, b[k].least) << a[k].signal;
    EXPECT_EQ(a[k].largest, b[k].largest) << a[k].signal;
  }
}

TEST_P(Resume, AStateOfAnotherMeshIsNoState) {
  Rig rig(GetParam());
  levels::StepState state = rig.motion->state();
  state.velocity.pop_back();
  EXPECT_THROW(rig.motion->restore(state, {}), std::logic_error);
}

// Empty at levels without codes.
std::string codes_of(const fs::path& folder) {
  const fs::path file = folder / "outputs_raw.npy";
  return fs::exists(file) ? content_of(file) : "";
}

TEST_P(Resume, AnyFolderGoesOnToTheSameFiles) {
  begin(6);
  go_on(6);
  const std::string positions = content_of(out / "positions.npy"), table = content_of(out / "steps.csv"),
                    codes = codes_of(out), glb = content_of(out / "mesh.glb"),
                    manifest = content_of(out / "manifest.json");
  for (std::uint64_t steps : {0, 1, 4, 5}) {
    begin(steps);
    if (steps < 3) go_on(3);
    go_on(6);
    EXPECT_TRUE(content_of(out / "positions.npy") == positions);
    EXPECT_TRUE(codes_of(out) == codes);
    EXPECT_TRUE(content_of(out / "mesh.glb") == glb);
    EXPECT_EQ(content_of(out / "steps.csv"), table);
    EXPECT_EQ(content_of(out / "manifest.json"), manifest);
    EXPECT_FALSE(fs::exists(out / "checkpoint"));
  }
}

TEST_P(Resume, ACheckpointThatAKillCutShortGoesWithTheRun) {
  begin(4);
  write_text(out / "checkpoint.part", "half");
  go_on(6);
  for (const auto& entry : fs::directory_iterator(out)) EXPECT_NE(entry.path().extension(), ".part");
}

TEST_P(Resume, RowsReadBackToTheSameBits) {
  begin(4);
  const auto found = run::read_run(out);
  ASSERT_EQ(found.rows.size(), 4u);
  Rig rig(GetParam());
  files::CsvWriter again(folder / "again.csv", run::step_header());
  for (const levels::StepRow& row : found.rows.kept()) {
    const levels::StepRow wanted = rig.motion->advance();
    EXPECT_EQ(row.hash, wanted.hash);
    EXPECT_EQ(row.kinetic, wanted.kinetic);
    EXPECT_EQ(row.max_stretch, wanted.max_stretch);
    EXPECT_EQ(row.converged, wanted.converged);
    ASSERT_EQ(row.error.has_value(), wanted.error.has_value());
    if (row.error) {
      EXPECT_EQ(row.error->energy_gap, wanted.error->energy_gap);
    }
    run::write_row(again, row);
  }
  again.commit();
  EXPECT_EQ(content_of(folder / "again.csv"), content_of(out / "steps.csv.part"));
}

TEST_P(Resume, AnOlderCheckpointDoesNotFitOtherFiles) {
  begin(3);
  fs::copy(out / "checkpoint", folder / "of-3");
  begin(5);
  fs::copy(out / "checkpoint", folder / "of-5");
  fs::copy(folder / "of-3", out / "checkpoint", fs::copy_options::overwrite_existing);
  EXPECT_EQ(refusal(), ""); // the files only grew since
  begin(3);
  fs::copy(folder / "of-5", out / "checkpoint", fs::copy_options::overwrite_existing);
  EXPECT_THAT(refusal(), HasSubstr("positions.npy: found positions.npy.part of "));
}

TEST_P(Resume, AStreamThatChangedIsNamedWithItsLineAndNothingIsTouched) {
  begin(3);
  for (const char* name : {"positions.npy.part", "steps.csv.part"}) {
    const std::string good = content_of(out / name);
    std::string bad = good;
    bad[good.size() - 9] ^= 1;
    write_text(out / name, bad);
    EXPECT_THAT(refusal(), ::testing::ContainsRegex("/checkpoint:[0-9]+: " + std::string(name).substr(0, 9)));
    EXPECT_EQ(content_of(out / name), bad);
    write_text(out / name, good);
  }
  EXPECT_EQ(refusal(), "");
}

TEST_P(Resume, AStateThatIsNotTheTablesIsRefused) {
  begin(3);
  auto saved = run::read_checkpoint(out / "checkpoint");
  saved.state.velocity[4] += 1;
  run::write_checkpoint(out / "checkpoint", saved);
  EXPECT_THAT(refusal(), HasSubstr("as in steps.csv"));
  saved.state.velocity.pop_back();
  run::write_checkpoint(out / "checkpoint", saved);
  EXPECT_THAT(refusal(),
              ::testing::ContainsRegex("/checkpoint:[0-9]+: velocity: found 17 values, expected 18"));
}

TEST_P(Resume, AnotherSceneIsRefusedByItsMesh) {
  begin(3);
  auto saved = run::read_checkpoint(out / "checkpoint");
  saved.scene.replace(saved.scene.find("pitch = 1.0"), 11, "pitch = 2.0");
  run::write_checkpoint(out / "checkpoint", saved);
  EXPECT_THAT(refusal(), ::testing::ContainsRegex("/checkpoint:[0-9]+: mesh: found "));
  saved.scene.replace(saved.scene.find("rows"), 4, "roes");
  run::write_checkpoint(out / "checkpoint", saved);
  EXPECT_THAT(refusal(), HasSubstr("/checkpoint:12: mesh.grid.roes")); // the line of the checkpoint itself
}

TEST(ResumeArray, AStoppedStepLeavesTheStateOfTheOneBefore) {
  SoftArray* port = nullptr;
  levels::Level soft{"soft"};
  soft.make_port = [&](const auto& array, const auto& topology, const auto&) {
    auto made = std::make_unique<SoftArray>(array, topology);
    port = made.get();
    return made;
  };
  Rig unbroken(soft), again(soft), rig(soft);
  rig.motion->advance();
  unbroken.motion->advance();
  port->stop = true;
  EXPECT_THROW(rig.motion->advance(), levels::Stopped);
  const levels::StepState state = rig.motion->state(), wanted = unbroken.motion->state();
  EXPECT_EQ(state.step, 1u);
  EXPECT_EQ(state.output, wanted.output);
  again.motion->restore(state, rig.motion->ranges());
  EXPECT_EQ(again.motion->advance().hash, unbroken.motion->advance().hash);
}

TEST(ReadRows, SayWhichLineIsNone) {
  const Folder folder;
  std::string header;
  for (const std::string& name : run::step_header()) header += (header.empty() ? "" : ",") + name;
  const std::string row = "0,0.05,1,2,3,4,5,6,1,0.5,,,7,8,9,10,,,,,,,0,0,,,,,,00000000000000ff\n";
  const auto read = [&](const std::string& text) {
    write_text(folder / "t.csv", text);
    return run::read_rows(folder / "t.csv", text.size());
  };
  EXPECT_EQ(read(header + '\n' + row).at(0).hash, 255u);
  for (const char* bad : {"0,0.05,1\n", "x,0.05,1,2,3,4,5,6,1,0.5,,,7,8,9,10,,,,,,,0,0,,,,,,ff\n",
                          "0,0,1,2,3,4,5,6,2,0.5,,,7,8,9,10,,,,,,,0,0,,,,,,ff\n",
                          "0,0,1,2,3,4,5,6,1,0.5,,,7,8,9,10,,1,,,,,0,0,,,,,,ff\n",
                          "0,0,1,2,3,4,5,6,1,0.5,,,7,8,9,10,,,,,,,0,0,,,,,,ff,1\n"}) {
    EXPECT_THAT(complaint([&] { read(header + '\n' + row + bad); }), HasSubstr("t.csv:3: found "));
  }
}

} // namespace
} // namespace hopmesh::tests
