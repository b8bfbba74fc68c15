// The flags of `hopmesh vectors`, and its work where they ask for one neuron.
#pragma once

#include "sim/cli/options.h"
#include "sim/cosim/level_vectors.h"

namespace hopmesh::cli {

struct VectorsOptions {
  input::InputWords words;
  std::int64_t step = -1, sweeps = 0, random = 0, taps = 0;
  std::uint64_t seed = 1;
  std::string out, check, format, level = levels::default_level().name;
  bool blank = false, neurons = false;
};

[[noreturn]] void refuse(const char* flag, const std::string& found, const std::string& expected);
/// The case that --step asks for, with --sweeps. None where the motion ends before; that is printed.
std::optional<cosim::VectorCase> step_case(const VectorsOptions& o);

/// What belongs to --neurons, or to nothing else. Throws input::InputError.
void check_neuron_options(const VectorsOptions& o);
int write_neurons(const VectorsOptions& o);
int judge_neurons(const VectorsOptions& o);

} // namespace hopmesh::cli
