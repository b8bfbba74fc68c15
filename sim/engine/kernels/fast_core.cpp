#include "sim/engine/kernels/fast_core.h"

#include "sim/engine/aligned.h"
#include "sim/engine/division.h"
#include "sim/engine/kernels/fast_layout.h"
#include "sim/engine/kernels/kernel_fit.h"

#include <atomic>
#include <cstring>

namespace hopmesh::engine {

namespace {

constexpr std::size_t L = block_lanes;

class FastCore : public SweepCore {
 public:
  FastCore(const NeuronPlan& plan, const Layout& layout, const KernelSet& kernels)
      : plan_(plan), layout_(layout), kernels_(kernels),
        per_cell_(static_cast<std::size_t>(plan.neurons_per_cell)), at_(layout, per_cell_) {
    const std::size_t neurons = layout.slots() * per_cell_, slots = layout.slots() + 2 * L;
    weight_.assign(at_.first_weight.back(), 0);
    bias_.assign(neurons, 0);
    state_ = bias_;
    multiplier_.assign(neurons, 0);
    if (per_cell_ > 1) xy_.assign(slots, 0);
    if (per_cell_ != 2) zz_.assign(slots, 0);
    if (synchronous()) next_xy_ = xy_, next_zz_ = zz_;
    set_arguments();
  }

  void put_weights(std::size_t slot, std::size_t p, std::size_t first_tap, const std::int32_t* codes,
                   std::size_t count) override {
    std::int16_t* row = weight_row(slot, p);
    for (std::size_t k = 0; k < count; ++k)
      row[at_.in_row(slot, first_tap + k)] = static_cast<std::int16_t>(codes[k]);
  }
  std::int32_t weight(std::size_t slot, std::size_t p, std::size_t tap) const override {
    return const_cast<FastCore*>(this)->weight_row(slot, p)[at_.in_row(slot, tap)];
  }
  void put_bias(std::size_t slot, std::size_t p, std::int32_t code) override { bias_[place(slot, p)] = code; }
  std::int32_t bias(std::size_t slot, std::size_t p) const override { return bias_[place(slot, p)]; }
  void put_state(std::size_t slot, std::size_t p, std::int32_t code) override {
    state_[place(slot, p)] = code;
    const auto link = static_cast<std::uint32_t>(rounded<std::int64_t>(code, args_.link)) & 0xFFFFu;
    if (per_cell_ == 1 || p == 2)
      zz_[slot] = link | link << 16;
    else
      xy_[slot] = p == 0 ? (xy_[slot] & 0xFFFF0000u) | link : (xy_[slot] & 0xFFFFu) | link << 16;
  }
  std::int32_t state(std::size_t slot, std::size_t p) const override { return state_[place(slot, p)]; }

  void prepare(std::size_t first, std::size_t last) override;
  void begin_run() override;
  void fire(std::size_t first, std::size_t last, SweepRecord& record) override {
    fire_(args_, first, last, record.lanes);
  }
  void end_sweep() override {
    if (!synchronous()) return;
    xy_.swap(next_xy_);
    zz_.swap(next_zz_);
    point_at_links();
  }
  void keep_outputs() override { kept_state_ = state_, kept_xy_ = xy_, kept_zz_ = zz_; }
  void restore_outputs() override {
    state_ = kept_state_, xy_ = kept_xy_, zz_ = kept_zz_;
    point_at_links();
  }
  std::size_t bytes_per_sweep() const override {
    return 4 * weight_.size() + sizeof(Source) * at_.source.size() + 4 * at_.far_slot.size() +
           layout_.slots() * (per_cell_ * (4 + 8 + 8) + 2 * 4 * std::max<std::size_t>(per_cell_ - 1, 1));
  }
  const char* name() const override { return kernels_.name; }

 private:
  bool synchronous() const { return plan_.schedule == spec::Schedule::synchronous; }
  std::size_t place(std::size_t slot, std::size_t p) const { return at_.place(slot, p); }
  std::int16_t* weight_row(std::size_t slot, std::size_t p) {
    return reinterpret_cast<std::int16_t*>(&weight_[at_.row(slot, p)]);
  }

  void set_arguments();
  void point_at_links();
  void invert(std::size_t at, std::uint64_t norm);

  const NeuronPlan& plan_;
  const Layout& layout_;
  const KernelSet& kernels_;
  const std::size_t per_cell_;
  const FastLayout at_;
  std::atomic<std::uint32_t> largest_row_{0};
  AlignedVector<std::uint32_t> weight_;
  AlignedVector<std::int32_t> bias_, state_, kept_state_;
  AlignedVector<std::int64_t> multiplier_;
  AlignedVector<std::uint32_t> xy_, zz_, next_xy_, next_zz_, kept_xy_, kept_zz_;
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
  const Normalise how = normalise_of(plan_);
  if (how == Normalise::scale) args_.drive = shift_rounding(plan_.scaled_down, f.drive.rounding);
  if (how == Normalise::multiply) args_.drive = shift_rounding(plan_.multiplier_places, f.drive.rounding);
  if (how == Normalise::divide) args_.division = kernel_division(plan_.ratio_up, f.drive.rounding);
  args_.state = state_.data();
  args_.state_rounding = shift_rounding(f.drive.fraction_bits(), f.state.rounding);
  args_.link = shift_rounding(plan_.link_down, f.link.rounding);
  point_at_links();
}

void FastCore::point_at_links() {
  args_.xy = xy_.data();
  args_.zz = zz_.data();
  args_.next_xy = synchronous() ? next_xy_.data() : xy_.data();
  args_.next_zz = synchronous() ? next_zz_.data() : zz_.data();
}

// The reciprocal is moved up to the point that the widest N would give.
void FastCore::invert(std::size_t at, std::uint64_t norm) {
  if (norm == 0) {
    multiplier_[at] = 0; // u = 0: an empty row stays as it is
  } else if (plan_.normaliser == spec::Normaliser::reciprocal) {
    const std::int64_t r = reciprocal(norm, plan_.reciprocal_bits);
    multiplier_[at] = r << (plan_.norm_bits - bit_length(norm));
  } else {
    const double inverse = 1.0 / static_cast<double>(norm);
    std::memcpy(&multiplier_[at], &inverse, sizeof inverse);
  }
}

void FastCore::prepare(std::size_t first, std::size_t last) {
  const RowKernel rows = kernels_.rows[per_cell_ - 1];
  const bool normalises = !plan_.binary && plan_.normaliser != spec::Normaliser::prescaled;
  std::vector<std::uint32_t> sums(per_cell_ * L);
  std::uint32_t largest = 0;
  for (std::size_t b = first; b < last; ++b) {
    rows(args_, b, sums.data());
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const std::size_t at = b * per_cell_ * L + k;
      largest = std::max(largest, sums[k]);
      if (!normalises) continue;
      const std::int64_t bias = bias_[at];
      invert(at, (std::uint64_t{sums[k]} << plan_.weight_up) +
                     (static_cast<std::uint64_t>(bias < 0 ? -bias : bias) << plan_.bias_up));
    }
  }
  for (std::uint32_t seen = largest_row_;
       largest > seen && !largest_row_.compare_exchange_weak(seen, largest);) {
  }
}

// 32 bits hold every sum of products if sum |w| times the largest |link| does.
void FastCore::begin_run() {
  const bool wide = std::uint64_t{largest_row_} * static_cast<std::uint64_t>(plan_.one_link) > INT32_MAX;
  const bool plain = args_.drive.plain() && args_.state_rounding.plain() && args_.link.plain();
  fire_ = kernels_.fire[per_cell_ - 1][static_cast<std::size_t>(normalise_of(plan_))][plain][wide];
  largest_row_ = 0;
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
