// Whole files of vectors: written with the answers of a level, and judged by them.
#pragma once

#include "sim/cosim/vectors.h"
#include "sim/levels/level.h"

namespace hopmesh::cosim {

/// The network that the driver loads in a step of the scene (of several expansions the last). None where the
/// motion ends before, and `ending` tells how. Throws levels::Stopped where the user stops it within a step.
std::optional<VectorCase> case_of_step(const levels::Prepared& prepared, std::uint64_t step,
                                       std::string& ending);
VectorCase random_case(std::uint64_t seed);

/// Case `number`, the same whenever it is asked for.
using CaseMaker = std::function<VectorCase(std::uint64_t number)>;
/// Cases 0 to `cases` - 1 with the answers of a level, or without any where that is null. False where the
/// user stopped it. Throws files::WriteError.
bool write_vectors(const std::filesystem::path& file, std::uint64_t cases, const CaseMaker& make,
                   const levels::Level* level);

struct VectorsJudged {
  std::uint64_t cases = 0, lines = 0; ///< judged right
  std::string wrong;                  ///< the first wrong line, in words; it ends the judgement
  bool interrupted = false;
};
/// Throws input::InputError for what is no file of vectors.
VectorsJudged judge_vectors(const std::string& file, const levels::Level& level);

} // namespace hopmesh::cosim
