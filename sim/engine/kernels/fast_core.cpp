#include "sim/engine/kernels/fast_core.h"

#include "sim/engine/aligned.h"
#include "sim/engine/kernels/fast_layout.h"
#include "sim/engine/kernels/kernel_fit.h"
#include "sim/engine/kernels/once_weights.h"
#include "sim/engine/kernels/row_inverse.h"

#include <atomic>

namespace hopmesh::engine {

namespace {

constexpr std::size_t L = block_lanes;

void raise(std::atomic<std::uint64_t>& most, std::uint64_t code) {
  for (std::uint64_t seen = most; code > seen && !most.compare_exchange_weak(seen, code);) {
  }
}

/// Kernels from the fastest to the one for any array: of the first two, rows as they are written may have
/// none.
enum class Way { once, slim, any };

class FastCore : public SweepCore {
 public:
  FastCore(const NeuronPlan& plan, const Layout& layout, const KernelSet& kernels)
      : plan_(plan), layout_(layout), kernels_(kernels),
        per_cell_(static_cast<std::size_t>(plan.neurons_per_cell)), at_(layout, per_cell_, synchronous()),
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
    if (fits_slim_) bias_ready_ = bias_, brief_.assign(neurons + L, 0);
    if (fits_slim_ && kernels.once && fits_brief(plan))
      once_ = std::make_unique<OnceWeights>(layout, at_, per_cell_, *kernels.once);
    choose();
    set_arguments();
  }

  void put_weights(std::size_t slot, std::size_t p, std::size_t first_tap, const std::int32_t* codes,
                   std::size_t count) override {
    std::int16_t* row = weight_row(slot, p);
    if (once_) once_->change();
    choose();
    for (std::size_t k = 0; k < count; ++k)
      row[at_.in_row(slot, first_tap + k)] = static_cast<std::int16_t>(codes[k]);
  }
  std::int32_t weight(std::size_t slot, std::size_t p, std::size_t tap) const override {
    return const_cast<FastCore*>(this)->weight_row(slot, p)[at_.in_row(slot, tap)];
  }
  void put_bias(std::size_t slot, std::size_t p, std::int32_t code) override {
    bias_[place(slot, p)] = code;
    choose();
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
  void keep_outputs() override;
  void restore_outputs() override;
  std::size_t bytes_per_sweep() const override;
  const char* name() const override { return kernels_.name; }

 private:
  void choose() { way_ = once_ && once_->may_fit() ? Way::once : fits_slim_ ? Way::slim : Way::any; }
  bool rows_fit();
  void put_inverse(std::size_t at, std::uint64_t norm);

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

  const NeuronPlan& plan_;
  const Layout& layout_;
  const KernelSet& kernels_;
  const std::size_t per_cell_;
  const FastLayout at_;
  const bool fits_slim_;
  Way way_ = Way::any;
  std::atomic<std::uint64_t> largest_row_{0}, largest_sum_{0}; ///< sum |w|; and s as large as it can be
  std::atomic<bool> lonely_{false};                            ///< some s has no divisor
  std::atomic<bool> long_{false};                              ///< some multiplier is not brief
  AlignedVector<std::uint32_t> weight_;
  AlignedVector<std::int32_t> bias_, bias_ready_, brief_, state_, ahead_, kept_state_, kept_ahead_;
  AlignedVector<std::int64_t> multiplier_, most_sum_;
  std::array<Links, 2> links_;
  Links kept_links_;
  std::unique_ptr<OnceWeights> once_; ///< of arrays that have kernels for it
  std::uint32_t turn_ = 0;            ///< sweeps up to now
  KernelArgs args_{};
  FireKernel fire_ = nullptr;
};

void FastCore::set_arguments() {
  args_ = arguments_of(plan_);
  args_.neighbours = at_.neighbours.data();
  args_.first_weight = at_.first_weight.data();
  args_.first_source = at_.first_source.data();
  args_.source = at_.source.data();
  args_.waits = at_.waits.data();
  args_.far_slot = at_.far_slot.data();
  args_.weight = weight_.data();
  args_.bias = bias_.data();
  args_.multiplier = multiplier_.data();
  args_.state = state_.data();
  args_.ahead = ahead_.data();
  args_.most_sum = most_sum_.data();
  args_.once.bias = bias_ready_.data();
  args_.once.multiplier = brief_.data();
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
  if (way_ == Way::once) {
    KernelArgs args = args_;
    once_->point(args.once, 1 - turn(0));
    return once_->kernels().show[per_cell_ - 1](args, 0, layout_.blocks());
  }
  ahead_ = state_;
  args_.ahead = ahead_.data();
  for (std::size_t slot = 0; slot < layout_.slots(); ++slot)
    for (std::size_t p = 0; p < per_cell_; ++p) show(slot, p, state_[place(slot, p)]);
}

void FastCore::keep_outputs() {
  kept_state_ = state_, kept_ahead_ = ahead_;
  if (way_ == Way::once) return once_->keep_links(turn(0));
  kept_links_ = links_[turn(0)];
}

void FastCore::restore_outputs() {
  state_ = kept_state_, ahead_ = kept_ahead_;
  if (way_ == Way::once) return once_->restore_links(turn(0));
  links_[turn(0)] = kept_links_;
  point();
}

// Outputs, Y and links are read and written; what a kernel reads twice near by counts once.
std::size_t FastCore::bytes_per_sweep() const {
  const std::size_t neurons = layout_.slots() * per_cell_;
  const bool brief = plan_.normaliser == spec::Normaliser::reciprocal;
  if (way_ == Way::once) return once_->bytes_per_sweep() + neurons * (4 + (brief ? 4 : 8) + 8 + 8 + 8);
  const std::size_t held = way_ == Way::slim ? 0 : 8 * most_sum_.size();
  return 4 * weight_.size() + sizeof(Source) * at_.source.size() + 4 * at_.far_slot.size() +
         neurons * (4 + 8 + 8) + layout_.slots() * 2 * 4 * std::max<std::size_t>(per_cell_ - 1, 1) + held +
         8 * ahead_.size();
}

void FastCore::fire(std::size_t first, std::size_t last, const SweepOrder& order, SweepRecord& record) {
  if (!synchronous()) return fire_(args_, first, last, record.lanes);
  KernelArgs args = args_;
  args.momentum = order.momentum;
  if (way_ == Way::once) {
    once_->point(args.once, turn(order.ahead));
  } else {
    const Links& from = links_[turn(order.ahead)];
    Links& to = links_[turn(order.ahead + 1)];
    args.xy = from.xy.data(), args.zz = from.zz.data();
    args.next_xy = to.xy.data(), args.next_zz = to.zz.data();
  }
  fire_(args, first, last, record.lanes);
}

void FastCore::put_inverse(std::size_t at, std::uint64_t norm) {
  if (way_ == Way::any) {
    const RowInverse inverse = plan_.hold > 0 ? held_inverse(plan_, norm) : modified_inverse(plan_, norm);
    multiplier_[at] = inverse.multiplier;
    if (plan_.hold > 0) most_sum_[at] = inverse.most_sum;
  } else if (way_ == Way::once && plan_.normaliser == spec::Normaliser::reciprocal) {
    brief_[at] = brief_inverse(plan_, norm);
    if (brief_[at] < 0) long_ = true;
  } else {
    multiplier_[at] = slim_inverse(plan_, norm).multiplier;
  }
}

void FastCore::prepare(std::size_t first, std::size_t last) {
  const RowKernel rows = kernels_.rows[per_cell_ - 1];
  const bool normalises = !plan_.binary && plan_.normaliser != spec::Normaliser::prescaled;
  std::vector<std::uint32_t> sums(per_cell_ * L);
  std::uint64_t largest = 0, sum = 0;
  for (std::size_t b = first; b < last; ++b) {
    rows(args_, b, sums.data());
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const std::size_t at = b * per_cell_ * L + k;
      const auto bias = static_cast<std::uint64_t>(std::abs(std::int64_t{bias_[at]}));
      if (way_ != Way::any)
        bias_ready_[at] = static_cast<std::int32_t>(std::int64_t{bias_[at]} << args_.bias_up);
      largest = std::max<std::uint64_t>(largest, sums[k]);
      sum = std::max(sum, sums[k] * static_cast<std::uint64_t>(plan_.one_link) + (bias << args_.bias_up));
      if (!normalises) continue;
      const std::int32_t own =
          plan_.output == spec::Output::projected ? weight(b * L + k % L, k / L, k / L) : 0;
      const std::uint64_t norm = row_divisor(plan_, own, sums[k], bias_[at]);
      if (norm == 0 && bias != 0) lonely_ = true;
      put_inverse(at, norm);
    }
  }
  raise(largest_row_, largest);
  raise(largest_sum_, sum);
}

/// Do the rows, as they were prepared, fit the kernels that they were prepared for?
bool FastCore::rows_fit() {
  if (way_ == Way::any) return true;
  const bool divider = plan_.normaliser == spec::Normaliser::divider;
  if (largest_sum_ > INT32_MAX || (divider && lonely_)) {
    way_ = Way::any;
    return false;
  }
  if (way_ == Way::slim) return true;
  once_->point(args_.once, 0);
  if (!lonely_ && !long_ && once_->pack(args_, layout_.blocks())) return true;
  way_ = Way::slim;
  return false;
}

// 32 bits hold every sum of products if sum |w| times the largest |link| does. Rows that are nothing for
// these kernels are prepared once more for others.
void FastCore::begin_run(bool by_sum) {
  const Normalise how = normalise_of(plan_);
  while (!rows_fit()) prepare(0, layout_.blocks());
  const bool wide = largest_row_ * static_cast<std::uint64_t>(plan_.one_link) > INT32_MAX;
  const bool plain =
      args_.drive.plain() && args_.state_rounding.plain() && args_.link.plain() && args_.step.plain();
  const auto& kernels = kernels_.fire[per_cell_ - 1][static_cast<std::size_t>(how)][by_sum];
  fire_ = is_ahead(how) ? kernels[way_ == Way::slim][way_ != Way::slim] : kernels[plain][wide];
  if (way_ == Way::once) fire_ = once_->kernels().fire[per_cell_ - 1][how == Normalise::ahead_divide][by_sum];
  largest_row_ = largest_sum_ = 0;
  lonely_ = long_ = false;
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
