// Any array that the description allows, written for the reader first: rows in lanes, 64-bit sums, 128-bit
// steps where a format asks for them.
#include "sim/engine/core.h"
#include "sim/engine/rounding.h"

#include <cstdlib>

namespace hopmesh::engine {

namespace {

constexpr std::size_t L = block_lanes;

int bit_length(std::uint64_t x) {
  return x == 0 ? 0 : 64 - __builtin_clzll(x);
}

class GenericCore : public Core {
 public:
  GenericCore(const Plan& plan, const Layout& layout)
      : plan_(plan), layout_(layout), per_cell_(static_cast<std::size_t>(plan.neurons_per_cell)),
        narrow_sums_(plan.exact || plan.sum_up <= 52), narrow_product_(product_bits() <= 62) {
    const std::size_t neurons = layout.slots() * per_cell_;
    first_weight_.assign(1, 0);
    for (std::uint32_t n : layout.neighbours)
      first_weight_.push_back(first_weight_.back() + taps_of(n) * per_cell_ * L);
    weight_.assign(first_weight_.back(), 0);
    bias_.assign(neurons, 0);
    state_ = bias_;
    link_ = next_link_ = bias_;
    norm_.assign(neurons, 0);
    reciprocal_ = norm_;
    places_.assign(neurons, 0);
  }

  void put_weights(std::size_t slot, std::size_t p, std::size_t first_tap, const std::int32_t* codes,
                   std::size_t count) override {
    std::int32_t* at = &weight_[weight_place(slot, p, first_tap)];
    for (std::size_t k = 0; k < count; ++k) at[k * L] = codes[k];
  }
  std::int32_t weight(std::size_t slot, std::size_t p, std::size_t tap) const override {
    return weight_[weight_place(slot, p, tap)];
  }
  void put_bias(std::size_t slot, std::size_t p, std::int32_t code) override { bias_[place(slot, p)] = code; }
  std::int32_t bias(std::size_t slot, std::size_t p) const override { return bias_[place(slot, p)]; }
  void put_state(std::size_t slot, std::size_t p, std::int32_t code) override {
    state_[place(slot, p)] = code;
    link_[slot * per_cell_ + p] = link_of(code);
  }
  std::int32_t state(std::size_t slot, std::size_t p) const override { return state_[place(slot, p)]; }

  void prepare(std::size_t first, std::size_t last) override {
    for (std::size_t b = first; b < last; ++b)
      for (std::size_t p = 0; p < per_cell_; ++p) prepare_rows(b, p);
  }
  void fire(std::size_t first, std::size_t last, Swept& swept) override {
    std::vector<std::int32_t> in(plan_.most_taps * L);
    for (std::size_t b = first; b < last; ++b) {
      gather(b, in.data());
      for (std::size_t p = 0; p < per_cell_; ++p) fire_rows(b, p, in.data(), swept);
    }
  }
  void end_sweep() override {
    if (plan_.schedule == spec::Schedule::synchronous) link_.swap(next_link_);
  }
  void keep_outputs() override { kept_ = {state_, link_}; }
  void restore_outputs() override {
    state_ = kept_[0];
    link_ = kept_[1];
  }
  std::size_t bytes_per_sweep() const override {
    return 4 * weight_.size() + 4 * layout_.source.size() + layout_.slots() * per_cell_ * (4 + 8 + 8 + 4);
  }
  const char* name() const override { return "generic"; }

 private:
  std::size_t taps_of(std::size_t neighbours) const { return per_cell_ * (1 + neighbours); }
  std::size_t place(std::size_t slot, std::size_t p) const {
    return (slot / L * per_cell_ + p) * L + slot % L;
  }
  std::size_t weight_place(std::size_t slot, std::size_t p, std::size_t tap) const {
    const std::size_t b = slot / L;
    return first_weight_[b] + (p * taps_of(layout_.neighbours[b]) + tap) * L + slot % L;
  }
  int product_bits() const { return plan_.formats.accumulator.width + plan_.reciprocal_bits; }

  std::int32_t link_of(std::int64_t state) const {
    return static_cast<std::int32_t>(round_shift(state, plan_.link_down, plan_.formats.link.rounding));
  }

  void prepare_rows(std::size_t b, std::size_t p) {
    const std::size_t taps = taps_of(layout_.neighbours[b]);
    for (std::size_t l = 0; l < L; ++l) {
      const std::size_t at = (b * per_cell_ + p) * L + l;
      const std::int32_t* w = &weight_[first_weight_[b] + p * taps * L + l];
      std::uint64_t sum = 0;
      for (std::size_t t = 0; t < taps; ++t)
        sum += static_cast<std::uint64_t>(std::abs(std::int64_t{w[t * L]}));
      const std::uint64_t norm =
          (sum << plan_.weight_up) +
          (static_cast<std::uint64_t>(std::abs(std::int64_t{bias_[at]})) << plan_.bias_up);
      norm_[at] = static_cast<std::int64_t>(norm);
      if (norm == 0) continue;
      const int exponent = bit_length(norm) + plan_.reciprocal_bits - 2;
      reciprocal_[at] = static_cast<std::int64_t>((Int128{1} << exponent) / static_cast<Int128>(norm));
      places_[at] = exponent - plan_.ratio_up;
    }
  }

  // The inputs of the block's rows, tap by tap.
  void gather(std::size_t b, std::int32_t* in) const {
    const std::size_t P = per_cell_;
    for (std::size_t l = 0; l < L; ++l)
      for (std::size_t q = 0; q < P; ++q) in[q * L + l] = link_[(b * L + l) * P + q];
    const std::uint32_t* source = layout_.source.data() + layout_.first_source[b];
    for (std::size_t k = 0; k < layout_.neighbours[b]; ++k)
      for (std::size_t l = 0; l < L; ++l)
        for (std::size_t q = 0; q < P; ++q) in[((k + 1) * P + q) * L + l] = link_[source[k * L + l] * P + q];
  }

  void fire_rows(std::size_t b, std::size_t p, std::int32_t* in, Swept& swept) {
    std::int64_t sum[L];
    const std::size_t taps = taps_of(layout_.neighbours[b]), first = (b * per_cell_ + p) * L;
    const std::int32_t* w = &weight_[first_weight_[b] + p * taps * L];
    if (plan_.exact)
      sum_exactly(w, in, taps, &bias_[first], sum);
    else if (narrow_sums_)
      sum_with_loss<std::int64_t>(w, in, taps, &bias_[first], sum);
    else
      sum_with_loss<Int128>(w, in, taps, &bias_[first], sum);
    for (std::size_t l = 0; l < L; ++l) finish(first + l, sum[l], swept);
    publish(b, p, &state_[first], in);
  }

  void sum_exactly(const std::int32_t* w, const std::int32_t* in, std::size_t taps, const std::int32_t* bias,
                   std::int64_t* sum) const {
    std::int64_t products[L] = {};
    for (std::size_t t = 0; t < taps; ++t)
      for (std::size_t l = 0; l < L; ++l) products[l] += std::int64_t{w[t * L + l]} * in[t * L + l];
    for (std::size_t l = 0; l < L; ++l)
      sum[l] =
          shifted_up(std::int64_t{bias[l]}, -plan_.bias_down) + shifted_up(products[l], plan_.product_up);
  }

  // The register is written once a beat, and each time rounded.
  template <typename Int>
  void sum_with_loss(const std::int32_t* w, const std::int32_t* in, std::size_t taps,
                     const std::int32_t* bias, std::int64_t* sum) const {
    const spec::NumberFormat& f = plan_.formats.accumulator;
    const auto lanes = static_cast<std::size_t>(plan_.lanes);
    for (std::size_t l = 0; l < L; ++l)
      sum[l] = limit_to_format(round_shift<Int128>(bias[l], plan_.bias_down, f.rounding), f);
    for (std::size_t t = 0; t < taps; t += lanes) {
      std::int64_t products[L] = {};
      for (std::size_t k = t; k < std::min(taps, t + lanes); ++k)
        for (std::size_t l = 0; l < L; ++l) products[l] += std::int64_t{w[k * L + l]} * in[k * L + l];
      for (std::size_t l = 0; l < L; ++l) {
        const Int fine =
            shifted_up<Int>(sum[l], plan_.sum_up) + shifted_up<Int>(products[l], plan_.product_up);
        sum[l] = limit_to_format(round_shift(fine, plan_.sum_up, f.rounding), f);
      }
    }
  }

  std::int64_t drive_of(std::size_t at, std::int64_t sum) const {
    const spec::NumberFormat& f = plan_.formats.drive;
    Int128 u = 0;
    if (plan_.normaliser == spec::Normaliser::prescaled)
      u = round_shift<Int128>(sum, plan_.scaled_down, f.rounding);
    else if (norm_[at] != 0 && plan_.normaliser == spec::Normaliser::divider)
      u = quotient(sum, norm_[at], f.rounding);
    else if (norm_[at] != 0 && narrow_product_ && places_[at] < 62)
      u = round_shift<std::int64_t>(sum * reciprocal_[at], places_[at], f.rounding);
    else if (norm_[at] != 0)
      u = round_shift<Int128>(Int128{sum} * reciprocal_[at], places_[at], f.rounding);
    const std::int64_t code = limit_to_format(u, f);
    return std::min(std::max(code, -plan_.one_drive), plan_.one_drive);
  }

  Int128 quotient(std::int64_t sum, std::int64_t norm, spec::Rounding mode) const {
    const int up = plan_.ratio_up;
    if (up < 0) return round_quotient<Int128>(sum, Int128{norm} << -up, mode);
    if (plan_.formats.accumulator.width + up <= 60 && bit_length(static_cast<std::uint64_t>(norm)) <= 60)
      return round_quotient<std::int64_t>(shifted_up(sum, up), norm, mode);
    return round_quotient<Int128>(shifted_up<Int128>(sum, up), norm, mode);
  }

  void finish(std::size_t at, std::int64_t sum, Swept& swept) {
    const std::int64_t u = drive_of(at, sum), V = state_[at];
    const std::int64_t R = u >= 0 ? plan_.one_state - V : plan_.one_state + V;
    const std::int64_t change =
        round_shift(R * u, plan_.formats.drive.fraction_bits(), plan_.formats.state.rounding);
    state_[at] = static_cast<std::int32_t>(V + change);
    swept.largest = std::max(swept.largest, change < 0 ? -change : change);
    swept.extremes.merge({sum, sum, u, u});
  }

  // Coloured and sequential: the cell's next neuron reads what this one has become.
  void publish(std::size_t b, std::size_t p, const std::int32_t* state, std::int32_t* in) {
    const bool later = plan_.schedule == spec::Schedule::synchronous;
    auto& link = later ? next_link_ : link_;
    for (std::size_t l = 0; l < L; ++l) {
      const std::int32_t code = link_of(state[l]);
      link[(b * L + l) * per_cell_ + p] = code;
      if (!later) in[p * L + l] = code;
    }
  }

  const Plan& plan_;
  const Layout& layout_;
  const std::size_t per_cell_;
  const bool narrow_sums_, narrow_product_;
  std::vector<std::size_t> first_weight_;       ///< of a block
  std::vector<std::int32_t> weight_;            ///< [block][p][tap][lane]
  std::vector<std::int32_t> bias_, state_;      ///< [block][p][lane]
  std::vector<std::int32_t> link_, next_link_;  ///< [slot][p]
  std::vector<std::int64_t> norm_, reciprocal_; ///< [block][p][lane]
  std::vector<int> places_;                     ///< that s times the reciprocal is moved down
  std::array<std::vector<std::int32_t>, 2> kept_;
};

} // namespace

Extremes Swept::all_extremes() const {
  Extremes all = extremes;
  for (std::size_t l = 0; l < 8; ++l)
    all.merge({swings.least_sum[l], swings.largest_sum[l], swings.least_drive[l], swings.largest_drive[l]});
  return all;
}

std::unique_ptr<Core> make_generic_core(const Plan& plan, const Layout& layout) {
  return std::make_unique<GenericCore>(plan, layout);
}

} // namespace hopmesh::engine
