#include "rtl_model/systemc/input_accumulator.h"

#include "rtl_model/systemc/rounding.h"

#include <cstdlib>

namespace hopmesh::systemc {

namespace {

int product_fraction(const spec::Formats& f) {
  return f.weight.fraction_bits() + f.link.fraction_bits();
}

int common_fraction(const spec::Formats& f) {
  return std::max(product_fraction(f), f.bias.fraction_bits());
}

int norm_fraction(const spec::Formats& f) {
  return std::max(f.weight.fraction_bits(), f.bias.fraction_bits());
}

} // namespace

InputAccumulator::InputAccumulator(sc_core::sc_module_name name, const spec::ArraySpec& array,
                                   const spec::NumberFormat& accumulator, std::size_t per_source,
                                   std::size_t taps)
    : sc_module(name), lanes_(array.lanes), format_(accumulator), exact_(array.exact_accumulator),
      product_up_(common_fraction(array.formats) - product_fraction(array.formats)),
      sum_up_(common_fraction(array.formats) - accumulator.fraction_bits()),
      bias_places_(array.formats.bias.fraction_bits() - accumulator.fraction_bits()),
      weight_norm_up_(norm_fraction(array.formats) - array.formats.weight.fraction_bits()),
      bias_norm_up_(norm_fraction(array.formats) - array.formats.bias.fraction_bits()),
      per_source_(per_source), weights_(taps, 0) {
  sources_.reserve(taps / per_source);
}

void InputAccumulator::begin_sum() {
  const auto& q = format_;
  sum_ = exact_ ? bias_ * (std::int64_t{1} << -bias_places_)
                : into_range<Wide>(round_places<Wide>(bias_, bias_places_, q.rounding), q);
}

void InputAccumulator::sum_beat(std::size_t k) {
  add(dot(k * lanes_, std::min(taps(), (k + 1) * lanes_)));
}

void InputAccumulator::sum_row() {
  begin_sum();
  if (exact_) return add(dot_row());
  for (std::size_t k = 0; k < beats(); ++k) sum_beat(k);
}

void InputAccumulator::begin_norm() {
  norm_ = std::abs(std::int64_t{bias_}) << bias_norm_up_;
}

void InputAccumulator::norm_beat(std::size_t k) {
  for (std::size_t t = k * lanes_; t < std::min(taps(), (k + 1) * lanes_); ++t)
    norm_ += std::abs(std::int64_t{weights_[t]}) << weight_norm_up_;
}

void InputAccumulator::norm_row() {
  begin_norm();
  for (std::size_t k = 0; k < beats(); ++k) norm_beat(k);
}

std::int64_t InputAccumulator::dot(std::size_t first, std::size_t last) const {
  std::int64_t products = 0;
  for (std::size_t t = first; t < last; ++t)
    products += std::int64_t{weights_[t]} * sources_[t / per_source_][t % per_source_];
  return products;
}

std::int64_t InputAccumulator::dot_row() const {
  std::int64_t products = 0;
  const std::int32_t* weight = weights_.data();
  for (const std::int32_t* source : sources_)
    for (std::size_t q = 0; q < per_source_; ++q) products += std::int64_t{*weight++} * source[q];
  return products;
}

// An exact accumulator has room for every place; any other is rounded each time its register is written.
void InputAccumulator::add(std::int64_t products) {
  if (exact_) {
    sum_ += products * (std::int64_t{1} << product_up_);
    return;
  }
  const Wide exact = Wide{sum_} * (Wide{1} << sum_up_) + Wide{products} * (Wide{1} << product_up_);
  sum_ = into_range(round_places(exact, sum_up_, format_.rounding), format_);
}

void InputAccumulator::trace(sc_core::sc_trace_file* file) const {
  sc_core::sc_trace(file, sum_, std::string(name()) + ".s", format_.width);
  sc_core::sc_trace(file, norm_, std::string(name()) + ".norm");
}

} // namespace hopmesh::systemc
