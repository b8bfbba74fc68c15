// An array and a mesh that the driver's tests put behind the bus.
#pragma once

#include "rtl_model/spec/capabilities.h"
#include "tests/support/firmware_mesh.h"

extern "C" {
#include "firmware/driver.h"
#include "firmware/registers.h"
}

namespace hopmesh::tests {

/// An array as its capability registers tell it.
struct FakeArray {
  std::uint32_t normaliser = HM_NORMALISER_DIVIDER, output = HM_OUTPUT_MODIFIED;
  spec::NumberFormat weight{16, 1, spec::Rounding::rnd, spec::Overflow::sat};
  spec::NumberFormat bias{24, 9, spec::Rounding::rnd, spec::Overflow::sat};
  spec::NumberFormat state{16, 2, spec::Rounding::trn_zero, spec::Overflow::sat};
  /// Where windows begin: nothing that a driver could have computed.
  std::uint32_t first_link = 0x7000, link = 0x9100, biases = 0x5550, outputs = 0x2340, weights = 0xABCDE000;
  /// Codes in a word.
  std::uint32_t of_bias = 1, of_output = 1, of_weight = 1, of_momentum = 1;
  std::uint32_t packing() const { return of_bias | of_output << 8 | of_weight << 16 | of_momentum << 24; }
  /// The table of m, of an array that has one.
  std::uint32_t momentum = 0x6660, momentum_words = 0;
};

/// A path of three free nodes 0 - 1 - 2, held by the pinned node 3: planar, so that it can be checked by
/// hand.
inline std::vector<PlainSpring> path_springs() {
  return {{0, 1, 1, 1}, {1, 2, 1, 1}, {2, 3, 1, 1}};
}

} // namespace hopmesh::tests
