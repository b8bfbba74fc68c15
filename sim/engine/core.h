// The memories of an array and one sweep over them: what a way of computing has to offer. Two do:
// generic_core (any array) and fast_core (16-bit weights and links in wide registers).
#pragma once

#include "rtl_model/spec/relaxation.h"
#include "sim/engine/kernels/kernel.h"
#include "sim/engine/layout.h"
#include "sim/engine/plan.h"

#include <memory>

namespace hopmesh::engine {

/// What fired blocks leave behind, in either form: a kernel's lanes, or the largest |Delta V| and the swings
/// themselves.
struct Swept {
  KernelSwings swings;
  std::int64_t largest = 0;
  spec::Extremes extremes;

  std::int64_t largest_change() const {
    std::int64_t most = largest;
    for (std::uint32_t change : swings.largest_change) most = std::max<std::int64_t>(most, change);
    return most;
  }
  void begin_sweep() {
    largest = 0;
    std::fill(std::begin(swings.largest_change), std::end(swings.largest_change), 0u);
  }
  spec::Extremes all_extremes() const;
};

/// Codes are those that the array's memories hold: in range, |V| <= 1. A slot is a cell's place in the
/// Layout.
class Core {
 public:
  virtual ~Core() = default;

  virtual void put_weights(std::size_t slot, std::size_t p, std::size_t first_tap, const std::int32_t* codes,
                           std::size_t count) = 0;
  virtual std::int32_t weight(std::size_t slot, std::size_t p, std::size_t tap) const = 0;
  virtual void put_bias(std::size_t slot, std::size_t p, std::int32_t code) = 0;
  virtual std::int32_t bias(std::size_t slot, std::size_t p) const = 0;
  virtual void put_state(std::size_t slot, std::size_t p, std::int32_t code) = 0;
  virtual std::int32_t state(std::size_t slot, std::size_t p) const = 0;

  /// N of every row and its reciprocal, for blocks [first, last).
  virtual void prepare(std::size_t first, std::size_t last) = 0;
  /// After all blocks were prepared, before the first sweep.
  virtual void begin_run() {}
  /// Fires every neuron of the blocks [first, last), as if one after the other; of one group or of several.
  virtual void fire(std::size_t first, std::size_t last, Swept& swept) = 0;
  /// After the last group of a sweep (synchronous arrays show the new outputs now).
  virtual void end_sweep() {}

  /// Outputs as they are now, kept and brought back: for sweeps that went too far.
  virtual void keep_outputs() = 0;
  virtual void restore_outputs() = 0;
  /// Bytes that a sweep reads and writes, for rooflines.
  virtual std::size_t bytes_per_sweep() const = 0;
  /// "generic", or the kernel's name.
  virtual const char* name() const = 0;
};

std::unique_ptr<Core> make_generic_core(const Plan& plan, const Layout& layout);

} // namespace hopmesh::engine
