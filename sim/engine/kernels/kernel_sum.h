// Sums of products of sixteen rows, for any instruction set: a part of kernel_body.h.
#pragma once

#include "sim/engine/kernels/kernel.h"

namespace hopmesh::engine {
namespace {

/// Sums of products of sixteen rows in 32 bits: for arrays whose every row fits.
template <typename Isa, bool wide> struct Sum {
  typename Isa::Words sum = Isa::no_words();
  void add(typename Isa::Words links, const std::uint32_t* weights) {
    sum = Isa::add_products(sum, links, weights);
  }
  typename Isa::Longs low() const { return Isa::low(sum); }
  typename Isa::Longs high() const { return Isa::high(sum); }
};

/// Sums in 64 bits, added pair by pair: for arrays with a row that 32 bits do not hold.
template <typename Isa> struct Sum<Isa, true> {
  typename Isa::Longs low_sum = Isa::all(0), high_sum = Isa::all(0);
  void add(typename Isa::Words links, const std::uint32_t* weights) {
    const auto pairs = Isa::add_products(Isa::no_words(), links, weights);
    low_sum = Isa::add(low_sum, Isa::low(pairs));
    high_sum = Isa::add(high_sum, Isa::high(pairs));
  }
  typename Isa::Longs low() const { return low_sum; }
  typename Isa::Longs high() const { return high_sum; }
};

} // namespace
} // namespace hopmesh::engine
