// Any array that the description allows: rows in lanes, 64 bits where they hold every code that the memories
// can hold, 128 where a format asks for them.
#include "sim/engine/generic/generic_core.h"

#include "sim/engine/aligned.h"
#include "sim/engine/generic/drive_path.h"
#include "sim/engine/generic/lane_arithmetic.h"
#include "sim/engine/generic/wide_sum.h"

#include <cstdlib>

namespace hopmesh::engine {

namespace {

constexpr std::size_t L = block_lanes;
static_assert(L == lane_count);

class GenericCore : public SweepCore {
 public:
  GenericCore(const NeuronPlan& plan, const Layout& layout)
      : plan_(plan), layout_(layout), per_cell_(static_cast<std::size_t>(plan.neurons_per_cell)), path_(plan),
        wide_sum_(plan), sum_limit_(plan.formats.accumulator),
        to_state_(shift_rounding(plan.formats.drive.fraction_bits(), plan.formats.state.rounding)),
        to_link_(shift_rounding(plan.link_down, plan.formats.link.rounding)),
        gained_(shift_rounding(spec::momentum_down, plan.formats.state.rounding)),
        step_(step_rounding(plan.step_down, plan.formats.state)) {
    const std::size_t neurons = layout.slots() * per_cell_;
    first_weight_.assign(1, 0);
    for (std::uint32_t n : layout.neighbours)
      first_weight_.push_back(first_weight_.back() + taps_of(n) * per_cell_ * L);
    weight_.assign(first_weight_.back(), 0);
    bias_.assign(neurons, 0);
    state_ = bias_;
    link_[0] = bias_;
    if (synchronous()) link_[1] = bias_;
    if (plan.output == spec::Output::momentum) ahead_ = bias_;
    norm_.assign(neurons, 0);
    reciprocal_ = norm_;
    places_.assign(neurons, 0);
    narrow_sums_ = !plan.exact && plan.sum_up <= 52;
    narrow_bias_ = std::abs(plan.bias_down) <= 30;
    if (narrow_sums_) to_sum_ = shift_rounding(plan.sum_up, plan.formats.accumulator.rounding);
    if (narrow_bias_)
      to_bias_ = shift_rounding(std::max(plan.bias_down, 0), plan.formats.accumulator.rounding);
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
    const std::size_t at = place(slot, p);
    state_[at] = code;
    if (!ahead_.empty()) ahead_[at] = code;
    link(0)[p * layout_.slots() + slot] = static_cast<std::int32_t>(rounded<std::int64_t>(code, to_link_));
  }
  std::int32_t state(std::size_t slot, std::size_t p) const override { return state_[place(slot, p)]; }

  void prepare(std::size_t first, std::size_t last) override {
    for (std::size_t b = first; b < last; ++b)
      for (std::size_t p = 0; p < per_cell_; ++p) prepare_rows(b, p);
  }
  void begin_run(bool by_sum) override {
    by_sum_ = by_sum;
    restart();
  }
  void fire(std::size_t first, std::size_t last, const SweepOrder& order, SweepRecord& record) override {
    std::vector<std::int32_t> in(plan_.most_taps * L);
    for (std::size_t b = first; b < last; ++b) {
      gather(b, link(order.ahead), in.data());
      for (std::size_t p = 0; p < per_cell_; ++p) fire_rows(b, p, order, in.data(), record);
    }
  }
  void end_sweeps(std::uint32_t count) override { turn_ += count; }
  void restart() override;
  void keep_outputs() override { kept_ = {state_, ahead_, link_[turn(0)]}; }
  void restore_outputs() override {
    state_ = kept_[0];
    ahead_ = kept_[1];
    link_[turn(0)] = kept_[2];
  }
  std::size_t bytes_per_sweep() const override {
    return 4 * (weight_.size() + layout_.source.size() + 2 * ahead_.size()) +
           layout_.slots() * per_cell_ * (4 + 8 + 8 + 4);
  }
  const char* name() const override { return "generic"; }

 private:
  /// Synchronous arrays have links of two sweeps, and take turns.
  std::size_t turn(std::uint32_t ahead) const { return synchronous() ? (turn_ + ahead) % 2 : 0; }
  std::int32_t* link(std::uint32_t ahead) { return link_[turn(ahead)].data(); }
  bool synchronous() const { return plan_.schedule == spec::Schedule::synchronous; }
  std::size_t taps_of(std::size_t neighbours) const { return per_cell_ * (1 + neighbours); }
  std::size_t place(std::size_t slot, std::size_t p) const {
    return (slot / L * per_cell_ + p) * L + slot % L;
  }
  std::size_t weight_place(std::size_t slot, std::size_t p, std::size_t tap) const {
    const std::size_t b = slot / L;
    return first_weight_[b] + (p * taps_of(layout_.neighbours[b]) + tap) * L + slot % L;
  }

  void prepare_rows(std::size_t b, std::size_t p);
  void invert(std::size_t at, std::uint64_t norm);
  void gather(std::size_t b, const std::int32_t* links, std::int32_t* in) const;
  void fire_rows(std::size_t b, std::size_t p, const SweepOrder& order, std::int32_t* in,
                 SweepRecord& record);
  void move(std::size_t first, const std::int64_t* sum, const std::int64_t* u, std::int32_t m,
            std::int32_t* link, SweepRecord& record);
  void sum_exactly(const std::int32_t* w, const std::int32_t* in, std::size_t taps, const std::int32_t* bias,
                   std::int64_t* sum) const;
  void begin_with_loss(const std::int32_t* bias, std::int64_t* sum) const;
  void sum_with_loss(const std::int32_t* w, const std::int32_t* in, std::size_t taps,
                     const std::int32_t* bias, std::int64_t* sum) const;

  const NeuronPlan& plan_;
  const Layout& layout_;
  const std::size_t per_cell_;
  const DrivePath path_;
  const WideSum wide_sum_;
  const Limit sum_limit_;
  const ShiftRounding to_state_, to_link_, gained_;
  const StepRounding step_;
  ShiftRounding to_sum_, to_bias_;
  bool narrow_sums_ = false, narrow_bias_ = false;  ///< a rounding accumulator stays within 63 bits
  std::vector<std::size_t> first_weight_;           ///< of a block
  AlignedVector<std::int32_t> weight_;              ///< [block][p][tap][lane]
  AlignedVector<std::int32_t> bias_, state_;        ///< [block][p][lane]
  AlignedVector<std::int32_t> ahead_;               ///< Y, of momentum: [block][p][lane]
  std::array<AlignedVector<std::int32_t>, 2> link_; ///< [p][slot]; the second of synchronous arrays
  std::uint32_t turn_ = 0;                          ///< sweeps up to now
  bool by_sum_ = false;
  AlignedVector<std::int64_t> norm_, reciprocal_; ///< [block][p][lane]
  std::vector<int> places_;                       ///< Inverse::places of each row
  std::array<AlignedVector<std::int32_t>, 3> kept_;
};

void GenericCore::prepare_rows(std::size_t b, std::size_t p) {
  const std::size_t taps = taps_of(layout_.neighbours[b]);
  for (std::size_t l = 0; l < L; ++l) {
    const std::size_t at = (b * per_cell_ + p) * L + l;
    const std::int32_t* w = &weight_[first_weight_[b] + p * taps * L + l];
    const bool own = plan_.output == spec::Output::projected;
    std::uint64_t sum = 0;
    for (std::size_t t = own ? p : 0; t < (own ? p + 1 : taps); ++t)
      sum += static_cast<std::uint64_t>(std::abs(std::int64_t{w[t * L]}));
    const std::int64_t bias = plan_.hold > 0 ? 0 : std::abs(std::int64_t{bias_[at]});
    invert(at, (sum << plan_.weight_up) + (static_cast<std::uint64_t>(bias) << plan_.bias_up));
  }
}

void GenericCore::invert(std::size_t at, std::uint64_t norm) {
  const DrivePath::Inverse inverse = path_.invert(norm);
  norm_[at] = static_cast<std::int64_t>(norm);
  reciprocal_[at] = inverse.multiplier;
  places_[at] = inverse.places;
}

// The inputs of the block's rows, tap by tap.
void GenericCore::gather(std::size_t b, const std::int32_t* links, std::int32_t* in) const {
  const std::uint32_t* source = layout_.source.data() + layout_.first_source[b];
  for (std::size_t q = 0; q < per_cell_; ++q) {
    const std::int32_t* plane = links + q * layout_.slots();
    std::copy_n(plane + b * L, L, in + q * L);
    for (std::size_t k = 0; k < layout_.neighbours[b]; ++k)
      gather_lanes(plane, source + k * L, in + ((k + 1) * per_cell_ + q) * L);
  }
}

// Coloured and sequential: the cell's next neuron reads what this one has become.
void GenericCore::fire_rows(std::size_t b, std::size_t p, const SweepOrder& order, std::int32_t* in,
                            SweepRecord& record) {
  alignas(64) std::int64_t sum[L], u[L];
  const std::size_t taps = taps_of(layout_.neighbours[b]), first = (b * per_cell_ + p) * L;
  const std::int32_t* w = &weight_[first_weight_[b] + p * taps * L];
  if (plan_.exact)
    sum_exactly(w, in, taps, &bias_[first], sum);
  else
    sum_with_loss(w, in, taps, &bias_[first], sum);
  path_.drives({&norm_[first], &reciprocal_[first], &places_[first]}, sum, u);
  spec::Extremes& x = record.extremes;
  Swing sums{x.least_sum, x.largest_sum}, driven{x.least_drive, x.largest_drive};
  widen_swing(sum, sums);
  widen_swing(u, driven);
  x = {sums.least, sums.largest, driven.least, driven.largest};
  std::int32_t* shown = link(order.ahead + 1) + p * layout_.slots() + b * L;
  if (by_sum_) {
    const std::int32_t* base = ahead_.empty() ? &state_[first] : &ahead_[first];
    record.largest_moving = std::max(
        record.largest_moving, largest_moving_sum(sum, base, plan_.least_at_one, plan_.most_at_minus_one));
  }
  move(first, sum, u, order.momentum, shown, record);
  if (!synchronous()) std::copy_n(shown, L, in + p * L);
}

void GenericCore::move(std::size_t first, const std::int64_t* sum, const std::int64_t* u, std::int32_t m,
                       std::int32_t* link, SweepRecord& record) {
  std::int64_t largest = 0;
  if (plan_.output == spec::Output::projected) {
    largest = step_lanes(u, plan_.one_state, step_, to_link_, &state_[first], link);
  } else if (plan_.output == spec::Output::momentum) {
    const Moved moved = momentum_lanes(u, sum, {plan_.one_state, m, step_, gained_, to_link_}, &state_[first],
                                       &ahead_[first], link);
    record.along += moved.along;
    largest = moved.largest;
  } else {
    largest = output_lanes(u, plan_.one_state, to_state_, to_link_, &state_[first], link);
  }
  record.largest = std::max(record.largest, largest);
}

void GenericCore::restart() {
  if (ahead_.empty()) return;
  ahead_ = state_;
  for (std::size_t slot = 0; slot < layout_.slots(); ++slot)
    for (std::size_t p = 0; p < per_cell_; ++p)
      link(0)[p * layout_.slots() + slot] =
          static_cast<std::int32_t>(rounded<std::int64_t>(state_[place(slot, p)], to_link_));
}

void GenericCore::sum_exactly(const std::int32_t* w, const std::int32_t* in, std::size_t taps,
                              const std::int32_t* bias, std::int64_t* sum) const {
  alignas(64) std::int64_t products[L] = {};
  add_lane_products(w, in, taps, products);
  for (std::size_t l = 0; l < L; ++l) sum[l] = bias[l];
  shift_and_add_lanes(sum, -plan_.bias_down, products, plan_.product_up);
}

void GenericCore::begin_with_loss(const std::int32_t* bias, std::int64_t* sum) const {
  if (narrow_bias_) {
    const std::int64_t up = std::int64_t{1} << std::max(-plan_.bias_down, 0);
    for (std::size_t l = 0; l < L; ++l) sum[l] = bias[l] * up;
    round_lanes(sum, to_bias_);
    return limit_lanes(sum, sum_limit_);
  }
  for (std::size_t l = 0; l < L; ++l) sum[l] = wide_sum_.begin(bias[l]);
}

// The register is written once a beat, and each time rounded.
void GenericCore::sum_with_loss(const std::int32_t* w, const std::int32_t* in, std::size_t taps,
                                const std::int32_t* bias, std::int64_t* sum) const {
  const auto lanes = static_cast<std::size_t>(plan_.lanes);
  begin_with_loss(bias, sum);
  if (narrow_sums_) return add_lane_groups(w, in, taps, lanes, plan_.product_up, to_sum_, sum_limit_, sum);
  for (std::size_t t = 0; t < taps; t += lanes) {
    alignas(64) std::int64_t products[L] = {};
    add_lane_products(w + t * L, in + t * L, std::min(taps - t, lanes), products);
    for (std::size_t l = 0; l < L; ++l) sum[l] = wide_sum_.add(sum[l], products[l]);
  }
}

} // namespace

std::unique_ptr<SweepCore> make_generic_core(const NeuronPlan& plan, const Layout& layout) {
  return std::make_unique<GenericCore>(plan, layout);
}

} // namespace hopmesh::engine
