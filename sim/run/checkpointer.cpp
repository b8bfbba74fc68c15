#include "sim/run/checkpointer.h"

#include "sim/run/checkpoint.h"

namespace hopmesh::run {

using Clock = std::chrono::steady_clock;

Checkpointer::Checkpointer(RunFiles& files, std::uint64_t every, double seconds, Safe safe)
    : files_(files), every_(every), seconds_(seconds), began_(Clock::now()), safe_(std::move(safe)) {}

// A step that ends the run as diverged is none to go on from: a resumed run comes to it again.
void Checkpointer::step(const levels::StepRow& row, const levels::Mover& motion) {
  const bool due = every_ > 0 && (row.step + 1) % every_ == 0;
  if (due && row.max_stretch < most_stretch) save(motion);
}

void Checkpointer::save(const levels::Mover& motion) {
  const RunFacts& facts = files_.facts();
  Checkpoint c;
  c.program = this_program();
  c.level = facts.level->name;
  c.command = facts.command;
  c.check = facts.check;
  c.every = every_;
  c.asked = facts.asked_steps;
  c.wall_seconds = seconds_ + std::chrono::duration<double>(Clock::now() - began_).count();
  c.mesh = files_.mesh_hash();
  c.image = files_.image_hash();
  c.scene = scene::scene_text(facts.inputs.scene);
  c.array = input::array_text(facts.inputs.array);
  c.ranges = motion.ranges();
  c.streams = files_.sync(); // first: the checkpoint speaks of what is on the disk
  c.state = motion.state();
  write_checkpoint(files_.folder() / checkpoint_name, c);
  safe_(c.state.step);
}

} // namespace hopmesh::run
