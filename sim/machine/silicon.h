// What an array is built of, counted from its description: parts, bits of memory, bits of multipliers
// (docs/hardware/machine.md, "Silicon").
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/topology.h"

namespace hopmesh::machine {

/// How many there are of each part.
struct Parts {
  std::uint64_t accumulators = 0;  ///< one an element; one a neuron where the array is not folded
  std::uint64_t multipliers = 0;   ///< of all accumulators
  std::uint64_t stages = 0;        ///< output stages
  std::uint64_t link_memories = 1; ///< copies of all links: one an element
  std::uint64_t link_banks = 1;    ///< of each of them
  std::uint64_t points = 1;        ///< that a neuron keeps, and a folded array shows: V, or V and Y
};
Parts parts_of(const spec::ArraySpec& array, const spec::Topology& topology);

/// Bits of N, which has no sign, for the longest row.
int norm_bits(const spec::ArraySpec& array, const spec::Topology& topology);
/// Bits that a kept reciprocal takes: its mantissa, and the bit length of N, by which it is shifted.
int reciprocal_bits(const spec::ArraySpec& array, const spec::Topology& topology);

/// Bits that are kept: memories, and the registers of accumulators.
struct MemoryBits {
  std::uint64_t weights = 0, biases = 0;
  std::uint64_t states = 0;      ///< V, and Y where there is one
  std::uint64_t links = 0;       ///< all copies and banks
  std::uint64_t norms = 0;       ///< N (or |w_ii|) where it is summed, and where it is kept to be divided by
  std::uint64_t reciprocals = 0; ///< of all neurons
  std::uint64_t sums = 0;        ///< accumulators, and hold registers in front of a shared stage
  std::uint64_t momentum = 0;    ///< the table of m

  std::uint64_t total() const {
    return weights + biases + states + links + norms + reciprocals + sums + momentum;
  }
};
MemoryBits memory_bits(const spec::ArraySpec& array, const spec::Topology& topology);

/// Over all multipliers the product of the widths of what they multiply.
struct MultiplierBits {
  std::uint64_t sums = 0;        ///< w L
  std::uint64_t outputs = 0;     ///< R u, or m by the change; none where a step is only added
  std::uint64_t normalisers = 0; ///< s r

  std::uint64_t total() const { return sums + outputs + normalisers; }
};
MultiplierBits multiplier_bits(const spec::ArraySpec& array, const spec::Topology& topology);

/// Of the subtractors of dividers, each as wide as N: one a divider that makes its bits one after the other,
/// one a bit where the divider of a shared stage takes a neuron every cycle.
std::uint64_t divider_bits(const spec::ArraySpec& array, const spec::Topology& topology);

} // namespace hopmesh::machine
