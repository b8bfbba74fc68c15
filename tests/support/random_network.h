// The random networks of sim/cosim beside the slow array that judges them, and where their weights stand.
#pragma once

#include "sim/cosim/random_job.h"
#include "tests/support/slow_array.h"

namespace hopmesh::tests {

using namespace cosim;

/// Word of the weight of neuron p of cell `to` from neuron q of cell `from`; the cells are equal or linked.
inline std::size_t weight_word(const spec::Topology& t, std::size_t to, std::size_t p, std::size_t from,
                               std::size_t q) {
  std::size_t block = 0;
  for (std::size_t k = t.first_link[to]; from != to && k < t.first_link[to + 1]; ++k)
    if (t.link_to[k] == from) block = 1 + k - t.first_link[to];
  return t.row_offset(to, p) + block * t.neurons_per_cell + q;
}

} // namespace hopmesh::tests
