#include "sim/levels/level.h"
#include "sim/run/resume.h"
#include "tests/campaigns/mutants/reader.h"
#include "tests/campaigns/mutants/repairs.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

#include <csignal>
#include <stdexcept>

namespace hopmesh::campaigns {

namespace {

namespace fs = std::filesystem;
using tests::content_of;

/// A run of two nodes that was killed behind its third checkpoint.
fs::path killed_run(const fs::path& folder, const std::string& words) {
  tests::Surroundings around;
  fs::create_directories(around.folder = folder.parent_path());
  const std::string name = folder.filename().string();
  tests::Program program(
      tests::words_of("run two-nodes --steps 100000 --checkpoint-every 2 --out " + name + ' ' + words),
      around);
  if (!program.wait_for("checkpoint: 6 of")) throw std::runtime_error("no checkpoint for " + name);
  program.send(SIGKILL);
  program.finish();
  return folder;
}

/// The level must be able to take up the state; SystemC's can be made once a process only.
void read_killed_run(const fs::path& folder) {
  run::ResumedRun found = run::read_run(folder);
  const levels::Level& level = levels::level_named(found.saved.level, "");
  if (level.made_ahead) return;
  const levels::Prepared prepared{std::move(found.inputs), std::move(found.mesh)};
  const levels::ReadyLevel ready = levels::make_ready(level, prepared, found.saved.check);
  ready.mover->restore(found.saved.state, found.saved.ranges);
}

// The checkpoint says that the stream is as it was written, whatever it is now.
void read_stream(const fs::path& folder, const std::string& name) {
  run::Checkpoint saved = run::read_checkpoint(folder / run::checkpoint_name);
  const std::string bytes = content_of(folder / (name + ".part"));
  files::RunningCheck check;
  check.add(bytes.data(), bytes.size());
  for (run::NamedMark& stream : saved.streams)
    if (stream.name == name) stream.mark = {bytes.size(), check.value()};
  run::write_checkpoint(folder / run::checkpoint_name, saved);
  read_killed_run(folder);
}

void read_table(const fs::path& folder) {
  read_stream(folder, "steps.csv");
}
void read_places(const fs::path& folder) {
  read_stream(folder, "positions.npy");
}

} // namespace

std::vector<Reader> readers_of_stopped_runs(const fs::path& made) {
  const fs::path engine = killed_run(made / "killed", "");
  const fs::path reference = killed_run(made / "killed-reference", "--level reference");
  const fs::path rival = killed_run(made / "killed-rival", "--level velocity_verlet");
  fs::create_directories(made / "ended");
  const std::string manifest =
      R"({"outcome": "finished", "step_hashes": ["0123456789abcdef"], "seconds": 1e3})";
  Seeds checkpoints;
  for (const fs::path& folder : {engine, reference, rival})
    checkpoints.push_back(content_of(folder / "checkpoint"));
  return {{"checkpoint", "checkpoint", checkpoints, engine, read_killed_run, repair_checkpoint, true},
          {"steps of a killed run",
           "steps.csv.part",
           {content_of(engine / "steps.csv.part")},
           engine,
           read_table,
           nullptr,
           true},
          {"positions of a killed run",
           "positions.npy.part",
           {content_of(engine / "positions.npy.part")},
           engine,
           read_places,
           nullptr,
           true},
          {"manifest", "manifest.json", {manifest}, made / "ended", read_killed_run}};
}

} // namespace hopmesh::campaigns
