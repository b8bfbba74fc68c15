#include "sim/engine/kernels/fast_core.h"

#include "sim/engine/aligned.h"
#include "sim/engine/kernels/fast_layout.h"
#include "sim/engine/kernels/kernel_fit.h"
#include "sim/engine/kernels/row_inverse.h"

#include <array>
#include <atomic>

namespace hopmesh::engine {

namespace {

constexpr std::size_t L = block_lanes;

void raise(std::atomic<std::uint64_t>& most, std::uint64_t code) {
  for (std::uint64_t seen = most; code > seen && !most.compare_exchange_weak(seen, code);) {
  }
}

class FastCore : public SweepCore {
 public:
  FastCore(const NeuronPlan& plan, const Layout& layout, const KernelSet& kernels)
      : plan_(plan), layout_(layout), kernels_(kernels),
        per_cell_(static_cast<std::size_t>(plan.neurons_per_cell)), at_(layout, per_cell_),
        fits_slim_(kernels.slim && fits_slim(plan)) {
    const std::size_t neurons = layout.slots() * per_cell_, slots = layout.slots() + 2 * L;
    weight_.assign(at_.first_weight.back(), 0);
    bias_.assign(neurons, 0);
    state_ = bias_;
    multiplier_.assign(neurons, 0);
    if (per_cell_ > 1) links_[0].xy.assign(slots, 0);
    if (per_cell_ != 2) links_[0].zz.assign(slots, 0);
    if (synchronous()) links_[1] = links_[0];
    if (plan.output == spec::Output::momentum) ahead_ = state_;
    if (plan.hold > 0) most_sum_ = multiplier_;
    slim_ = fits_slim_;
    set_arguments();
  }

  void put_weights(std::size_t slot, std::size_t p, std::size_t first_tap, const std::int32_t* codes,
                   std::size_t count) override {
    std::int16_t* row = weight_row(slot, p);
    slim_ = fits_slim_;
    for (std::size_t k = 0; k < count; ++k)
      row[at_.in_row(slot, first_tap + k)] = static_cast<std::int16_t>(codes[k]);
  }
  std::int32_t weight(std::size_t slot, std::size_t p, std::size_t tap) const override {
    return const_cast<FastCore*>(this)->weight_row(slot, p)[at_.in_row(slot, tap)];
  }
  void put_bias(std::size_t slot, std::size_t p, std::int32_t code) override {
    bias_[place(slot, p)] = code;
    slim_ = fits_slim_;
  }
  std::int32_t bias(std::size_t slot, std::size_t p) const override { return bias_[place(slot, p)]; }
  void put_state(std::size_t slot, std::size_t p, std::int32_t code) override {
    state_[place(slot, p)] = code;
    if (!ahead_.empty()) ahead_[place(slot, p)] = code;
    show(slot, p, code);
  }
  std::int32_t state(std::size_t slot, std::size_t p) const override { return state_[place(slot, p)]; }

  void prepare(std::size_t first, std::size_t last) override;
  void begin_run(bool by_sum) override;
  void fire(std::size_t first, std::size_t last, const SweepOrder& order, SweepRecord& record) override;
  void end_sweeps(std::uint32_t count) override { turn_ += count; }
  void restart() override;
  void keep_outputs() override { kept_state_ = state_, kept_ahead_ = ahead_, kept_links_ = links_[turn(0)]; }
  void restore_outputs() override {
    state_ = kept_state_, ahead_ = kept_ahead_, links_[turn(0)] = kept_links_;
    point();
  }
  std::size_t bytes_per_sweep() const override {
    const std::size_t held = slim_ ? 0 : 8 * most_sum_.size();
    return 4 * weight_.size() + sizeof(Source) * at_.source.size() + 4 * at_.far_slot.size() +
           layout_.slots() * (per_cell_ * (4 + 8 + 8) + 2 * 4 * std::max<std::size_t>(per_cell_ - 1, 1)) +
           held + 8 * ahead_.size();
  }
  const char* name() const override { return kernels_.name; }

 private:
  bool synchronous() const { return plan_.schedule == spec::Schedule::synchronous; }
  std::size_t place(std::size_t slot, std::size_t p) const { return at_.place(slot, p); }
  std::int16_t* weight_row(std::size_t slot, std::size_t p) {
    return reinterpret_cast<std::int16_t*>(&weight_[at_.row(slot, p)]);
  }

  /// What neighbours see, by slot; two of them in synchronous arrays, which take turns.
  struct Links {
    AlignedVector<std::uint32_t> xy, zz;
  };
  std::size_t turn(std::uint32_t ahead) const { return synchronous() ? (turn_ + ahead) % 2 : 0; }
  void show(std::size_t slot, std::size_t p, std::int32_t code);
  void set_arguments();
  void point();
  std::uint64_t divisor(std::size_t block, std::size_t row, std::uint32_t sum) const;

  const NeuronPlan& plan_;
  const Layout& layout_;
  const KernelSet& kernels_;
  const std::size_t per_cell_;
  const FastLayout at_;
  const bool fits_slim_;
  bool slim_ = false; ///< rows, as they are written, may be for slim kernels
  std::atomic<std::uint64_t> largest_row_{0}, largest_sum_{0}; ///< sum |w|; and s as large as it can be
  std::atomic<bool> lonely_{false};                            ///< some s has no divisor
  AlignedVector<std::uint32_t> weight_;
  AlignedVector<std::int32_t> bias_, state_, ahead_, kept_state_, kept_ahead_;
  AlignedVector<std::int64_t> multiplier_, most_sum_;
  std::array<Links, 2> links_;
  Links kept_links_;
  std::uint32_t turn_ = 0; ///< sweeps up to now
  KernelArgs args_{};
  FireKernel fire_ = nullptr;
};

void FastCore::set_arguments() {
  const spec::Formats& f = plan_.formats;
  args_.neighbours = at_.neighbours.data();
  args_.first_weight = at_.first_weight.data();
  args_.first_source = at_.first_source.data();
  args_.source = at_.source.data();
  args_.waits = at_.waits.data();
  args_.far_slot = at_.far_slot.data();
  args_.weight = weight_.data();
  args_.bias = bias_.data();
  args_.multiplier = multiplier_.data();
  args_.synchronous = synchronous();
  args_.bias_up = -plan_.bias_down;
  args_.state_fraction = f.state.fraction_bits();
  args_.one_drive = plan_.one_drive;
  args_.one_state = plan_.one_state;
  args_.at_one = plan_.least_at_one;
  args_.at_minus_one = plan_.most_at_minus_one;
  const Normalise how = normalise_of(plan_);
  if (how == Normalise::scale) args_.drive = shift_rounding(plan_.scaled_down, f.drive.rounding);
  if (how == Normalise::multiply || how == Normalise::step_multiply || how == Normalise::ahead_multiply)
    args_.drive = shift_rounding(plan_.multiplier_places, f.drive.rounding);
  if (divides(how)) args_.division = kernel_division(plan_.ratio_up, f.drive.rounding);
  args_.state = state_.data();
  args_.state_rounding = shift_rounding(f.drive.fraction_bits(), f.state.rounding);
  args_.link = shift_rounding(plan_.link_down, f.link.rounding);
  args_.ahead = ahead_.data();
  args_.most_sum = most_sum_.data();
  args_.step_up = std::max(-plan_.step_down, 0);
  args_.step = shift_rounding(std::max(plan_.step_down, 0), f.state.rounding);
  args_.gained = shift_rounding(spec::momentum_down, f.state.rounding);
  args_.beyond_up = f.drive.fraction_bits() + 2;
  args_.most_drive = plan_.most_drive;
  args_.gain = plan_.gain;
  if (fits_slim_) args_.slim = slim_quotient(plan_);
  point();
}

void FastCore::point() {
  args_.xy = links_[0].xy.data();
  args_.zz = links_[0].zz.data();
  args_.next_xy = links_[0].xy.data();
  args_.next_zz = links_[0].zz.data();
}

void FastCore::show(std::size_t slot, std::size_t p, std::int32_t code) {
  Links& links = links_[turn(0)];
  const auto link = static_cast<std::uint32_t>(rounded<std::int64_t>(code, args_.link)) & 0xFFFFu;
  if (per_cell_ == 1 || p == 2)
    links.zz[slot] = link | link << 16;
  else
    links.xy[slot] = p == 0 ? (links.xy[slot] & 0xFFFF0000u) | link : (links.xy[slot] & 0xFFFFu) | link << 16;
}

void FastCore::restart() {
  if (ahead_.empty()) return;
  ahead_ = state_;
  args_.ahead = ahead_.data();
  for (std::size_t slot = 0; slot < layout_.slots(); ++slot)
    for (std::size_t p = 0; p < per_cell_; ++p) show(slot, p, state_[place(slot, p)]);
}

void FastCore::fire(std::size_t first, std::size_t last, const SweepOrder& order, SweepRecord& record) {
  if (!synchronous()) return fire_(args_, first, last, record.lanes);
  KernelArgs args = args_;
  const Links& from = links_[turn(order.ahead)];
  Links& to = links_[turn(order.ahead + 1)];
  args.xy = from.xy.data(), args.zz = from.zz.data();
  args.next_xy = to.xy.data(), args.next_zz = to.zz.data();
  args.momentum = order.momentum;
  fire_(args, first, last, record.lanes);
}

/// What divides s of a row of the block, [p][lane], whose |w| add up to `sum`.
std::uint64_t FastCore::divisor(std::size_t block, std::size_t row, std::uint32_t sum) const {
  const std::size_t p = row / L;
  if (plan_.output == spec::Output::projected)
    return static_cast<std::uint64_t>(std::abs(weight(block * L + row % L, p, p))) << plan_.weight_up;
  const std::int64_t bias = plan_.hold > 0 ? 0 : bias_[block * per_cell_ * L + row];
  return (std::uint64_t{sum} << plan_.weight_up) +
         (static_cast<std::uint64_t>(std::abs(bias)) << plan_.bias_up);
}

void FastCore::prepare(std::size_t first, std::size_t last) {
  const RowKernel rows = kernels_.rows[per_cell_ - 1];
  const bool normalises = !plan_.binary && plan_.normaliser != spec::Normaliser::prescaled;
  const auto invert = slim_ ? slim_inverse : plan_.hold > 0 ? held_inverse : modified_inverse;
  std::vector<std::uint32_t> sums(per_cell_ * L);
  std::uint64_t largest = 0, sum = 0;
  for (std::size_t b = first; b < last; ++b) {
    rows(args_, b, sums.data());
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const std::size_t at = b * per_cell_ * L + k;
      const auto bias = static_cast<std::uint64_t>(std::abs(std::int64_t{bias_[at]}));
      largest = std::max<std::uint64_t>(largest, sums[k]);
      sum = std::max(sum, sums[k] * static_cast<std::uint64_t>(plan_.one_link) + (bias << args_.bias_up));
      if (!normalises) continue;
      const std::uint64_t norm = divisor(b, k, sums[k]);
      if (norm == 0 && bias != 0) lonely_ = true;
      const RowInverse inverse = invert(plan_, norm);
      multiplier_[at] = inverse.multiplier;
      if (!slim_ && plan_.hold > 0) most_sum_[at] = inverse.most_sum;
    }
  }
  raise(largest_row_, largest);
  raise(largest_sum_, sum);
}

// 32 bits hold every sum of products if sum |w| times the largest |link| does. Rows that are nothing for slim
// kernels are prepared once more for the others.
void FastCore::begin_run(bool by_sum) {
  const Normalise how = normalise_of(plan_);
  const auto divider = plan_.normaliser == spec::Normaliser::divider;
  if (slim_ && (largest_sum_ > INT32_MAX || (divider && lonely_))) {
    slim_ = false;
    prepare(0, layout_.blocks());
  }
  const bool wide = largest_row_ * static_cast<std::uint64_t>(plan_.one_link) > INT32_MAX;
  const bool plain =
      args_.drive.plain() && args_.state_rounding.plain() && args_.link.plain() && args_.step.plain();
  const auto& kernels = kernels_.fire[per_cell_ - 1][static_cast<std::size_t>(how)][by_sum];
  fire_ = is_ahead(how) ? kernels[slim_][!slim_] : kernels[plain][wide];
  largest_row_ = largest_sum_ = 0;
  lonely_ = false;
  restart();
}

} // namespace

const KernelSet* kernel_set(const std::string& name) {
#ifdef HOPMESH_X86_KERNELS
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vnni");
  if (avx512 && (name.empty() || name == "avx512")) return &avx512_kernels;
  if (__builtin_cpu_supports("avx2") && (name.empty() || name == "avx2")) return &avx2_kernels;
#endif
  return name.empty() || name == "portable" ? &portable_kernels : nullptr;
}

std::unique_ptr<SweepCore> make_fast_core(const NeuronPlan& plan, const Layout& layout,
                                          const KernelSet& kernels) {
  return std::make_unique<FastCore>(plan, layout, kernels);
}

} // namespace hopmesh::engine
