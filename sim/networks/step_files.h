// The network of a step as files that other programs read.
#pragma once

#include "sim/levels/prepared.h"
#include "sim/levels/reference_mover.h"

#include <filesystem>

namespace hopmesh::networks {

/// Makes sure before any work that they can be written; throws files::WriteError.
void check_step_files(const std::filesystem::path& folder, const levels::BuiltMesh& mesh);
/// W.mtx, bias.mtx, V0.mtx, V.mtx and predicted.npy of the last step.
void write_step_files(const std::filesystem::path& folder, const levels::ReferenceMover& motion);

/// How near V of the last step is to its network's answer, and how near an array would come, in lines for
/// people; empty where the network is of the probe, which nothing bounds.
std::string certain_text(const levels::ReferenceMover& motion, const levels::Prepared& prepared);

} // namespace hopmesh::networks
