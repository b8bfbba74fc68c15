// The simulation as a library: reads a shipped scene, changes one number, and moves its mesh in double
// precision.
#include "sim/levels/reference_mover.h"
#include "sim/scene/scene_file.h"

#include <cstdio>

using namespace hopmesh;

int main() {
  try {
    const scene::Inputs inputs = scene::read_inputs(SCENES "/two-nodes.toml", "", {"motion.friction=1.0"});
    const levels::BuiltMesh mesh(inputs.scene);
    levels::ReferenceMover motion(inputs.scene, mesh, inputs.array);
    for (int step = 0; step < inputs.scene.motion.steps; ++step) {
      const levels::StepRow row = motion.advance();
      const double z = motion.positions()[5]; // of node 1: x y z of node 0 come first
      if (step % 10 == 9) std::printf("t = %.1f s  z = %.4f m  strain %.1e\n", row.time, z, row.max_strain);
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "pendulum: %s\n", e.what());
    return 1;
  }
}
