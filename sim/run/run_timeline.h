// Where the time of a run went, as measured: all of it, and that of a typical step.
#pragma once

#include "sim/run/machine_info.h"
#include "sim/run/run_facts.h"
#include "sim/run/step_log.h"

namespace hopmesh::run {

/// Of all steps, at a level of the array.
machine::Timeline timeline_of_run(const RunFacts& facts, const levels::BuiltMesh& mesh, const StepLog& rows);

/// An emulated host in a phrase.
std::string host_text(const scene::HostSpec& host);

/// The step in the middle, by sweeps, of those that are kept; none without steps.
const levels::StepRow* typical_step(const StepLog& rows);
/// Lanes of that step and shares of all of them, for the report.
pictures::Drawing timeline_drawing(const RunFacts& facts, const levels::BuiltMesh& mesh, const StepLog& rows);
/// What that step asked of the array.
StepLoad typical_load(const RunFacts& facts, const StepLog& rows);

} // namespace hopmesh::run
