// What the cost of a part grows with, counted from the parameters of its Verilog: bits that are kept, cells
// of multipliers, bits of adders, bits that are chosen among. The fitted model is a sum of them, each with a
// weight.
#pragma once

#include "sim/machine/cost/cost_figures.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace hopmesh::machine {

/// Parameters of hm_device by name.
using Parameters = std::map<std::string, std::int64_t>;

/// The first one is 1: what a part costs anyhow. Throws std::out_of_range where a parameter is missing.
std::vector<double> features_of(Part part, const Parameters& parameters);

/// How many there are of a part.
double count_of(Part part, const Parameters& parameters);

} // namespace hopmesh::machine
