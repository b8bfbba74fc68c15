// What the engine's tests share: a job put on an engine and held against the bit-serial array; the kernels
// that this machine has; random arrays that the kernels take.
#pragma once

#include "sim/engine/engine.h"
#include "tests/support/random_network.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {

using Codes = std::vector<std::int32_t>;

/// Kernels of this processor, "generic" first; what is missing is told once.
const std::vector<std::string>& kernels_here();

/// Why no fast kernel takes this array on rows of this mesh; empty if they do.
std::string why_not_fast(const spec::ArraySpec& array, const spec::Topology& topology);

/// Any array that the kernels take: 4 to 16 bits for weights and links, up to 32 for the rest, every mode by
/// itself. `normaliser` and `output`: as they should be.
spec::ArraySpec random_fast_array(Dice& dice, const spec::Topology& topology, spec::Normaliser normaliser,
                                  spec::Output output = spec::Output::modified);

/// Roundings that only add, and few bits of the reciprocal: what slim kernels want.
void make_slim(Dice& dice, spec::ArraySpec& array);
/// A rule to stop by, and a table of m where the array has one.
void give_rule(Dice& dice, ArrayJob& job);

void load(engine::Engine& e, const ArrayJob& job);
Codes outputs(const engine::Engine& e);

/// Everything that a run leaves behind equals what the slow array has.
void expect_result(const engine::Engine& e, const ArrayResult& expected);
/// Loads, runs and compares.
void expect_run(engine::Engine& e, const ArrayJob& job, const ArrayResult& expected);

/// For SCOPED_TRACE.
std::string text(const engine::Options& options);

/// Largest |Delta V| of each sweep of a history that began at `start`, by subtraction.
std::vector<std::uint32_t> changes_of(const ArrayJob& job, const ArrayResult& result);

} // namespace hopmesh::tests
