// Steps in which outputs differ although energies agree: the network decides nothing there.
#pragma once

#include "sim/run/run_totals.h"

namespace hopmesh::cosim {

/// An output further than this from the reference's, where the energies agree to this part of the step's
/// fall, is undecided: both answers are as good.
inline constexpr double far_output = 0.1, equal_energy = 0.05;

bool is_undecided(const levels::StepRow& row);

/// A line or two for people, indented like the figures of a comparison; "" where every step is decided.
std::string undecided_text(const run::StepRows& rows);

} // namespace hopmesh::cosim
