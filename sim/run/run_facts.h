// What a run was, beside its steps: everything that manifest, statistics and report say of it.
#pragma once

#include "sim/levels/level.h"

namespace hopmesh::run {

struct RunFacts {
  scene::Inputs inputs;
  const levels::Level* level = nullptr; ///< never null
  std::string command;                  ///< that repeats the run, but for its --steps
  std::uint64_t asked_steps = 0;        ///< --steps; 0: as many as the scene says
  bool check = false;                   ///< the reference is asked
};

} // namespace hopmesh::run
