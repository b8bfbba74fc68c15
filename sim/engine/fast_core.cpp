#include "sim/engine/fast_core.h"

#include "sim/engine/aligned.h"
#include "sim/engine/fast_plan.h"

#include <atomic>
#include <cstring>

namespace hopmesh::engine {

namespace {

constexpr std::size_t L = block_lanes;

class FastCore : public Core {
 public:
  FastCore(const Plan& plan, const Layout& layout, const KernelSet& kernels)
      : plan_(plan), layout_(layout), kernels_(kernels),
        per_cell_(static_cast<std::size_t>(plan.neurons_per_cell)), norm_bits_(norm_bits(plan)) {
    align_neighbours();
    lay_out_weights();
    find_sources();
    const std::size_t neurons = layout.slots() * per_cell_, slots = layout.slots() + 2 * L;
    weight_.assign(first_weight_.back(), 0);
    bias_.assign(neurons, 0);
    state_ = bias_;
    multiplier_.assign(neurons, 0);
    xy_.assign(slots, 0);
    if (per_cell_ == 3) zz_.assign(slots, 0);
    if (synchronous()) next_xy_ = xy_, next_zz_ = zz_;
    set_arguments();
  }

  void put_weights(std::size_t slot, std::size_t p, std::size_t first_tap, const std::int32_t* codes,
                   std::size_t count) override {
    std::int16_t* row = weight_row(slot, p);
    for (std::size_t k = 0; k < count; ++k)
      row[tap_place(slot, first_tap + k)] = static_cast<std::int16_t>(codes[k]);
  }
  std::int32_t weight(std::size_t slot, std::size_t p, std::size_t tap) const override {
    return const_cast<FastCore*>(this)->weight_row(slot, p)[tap_place(slot, tap)];
  }
  void put_bias(std::size_t slot, std::size_t p, std::int32_t code) override { bias_[place(slot, p)] = code; }
  std::int32_t bias(std::size_t slot, std::size_t p) const override { return bias_[place(slot, p)]; }
  void put_state(std::size_t slot, std::size_t p, std::int32_t code) override {
    state_[place(slot, p)] = code;
    const KernelRounding& r = args_.link;
    const std::int64_t x = code;
    const std::int64_t sum = x + r.add + (x < 0 ? r.add_if_negative : 0) + ((x >> r.places) & r.add_if_odd);
    const auto link = static_cast<std::uint32_t>(sum >> r.places) & 0xFFFFu;
    std::uint32_t& xy = xy_[slot];
    if (p == 0) xy = (xy & 0xFFFF0000u) | link;
    if (p == 1) xy = (xy & 0xFFFFu) | link << 16;
    if (p == 2) zz_[slot] = link | link << 16;
  }
  std::int32_t state(std::size_t slot, std::size_t p) const override { return state_[place(slot, p)]; }

  void prepare(std::size_t first, std::size_t last) override;
  void begin_run() override;
  void fire(std::size_t first, std::size_t last, Swept& swept) override {
    fire_(args_, first, last, swept.swings);
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
    return 4 * weight_.size() + sizeof(Source) * source_.size() + 4 * far_slot_.size() +
           layout_.slots() * (per_cell_ * (4 + 8 + 8) + 2 * 4 * (per_cell_ - 1));
  }
  const char* name() const override { return kernels_.name; }

 private:
  bool synchronous() const { return plan_.schedule == spec::Schedule::synchronous; }
  std::size_t place(std::size_t slot, std::size_t p) const {
    return (slot / L * per_cell_ + p) * L + slot % L;
  }
  std::size_t pairs(std::size_t n) const { return per_cell_ == 3 ? 2 + n + n / 2 : 1 + n; }
  std::uint32_t degree(std::size_t slot) const { return layout_.degree[slot]; }
  std::uint32_t neighbour(std::size_t slot, std::size_t k) const {
    const std::size_t b = slot / L;
    return layout_.source[layout_.first_source[b] + k * L + slot % L];
  }
  /// How far off the k-th neighbour is, in cell numbers.
  std::int64_t way(std::size_t slot, std::size_t k) const {
    return std::int64_t{layout_.cell_of_slot[neighbour(slot, k)]} - layout_.cell_of_slot[slot];
  }
  std::int16_t* weight_row(std::size_t slot, std::size_t p) {
    const std::size_t block = slot / L;
    std::uint32_t* row = &weight_[first_weight_[block] + p * L + slot % L];
    return reinterpret_cast<std::int16_t*>(row);
  }
  std::size_t tap_place(std::size_t slot, std::size_t tap) const {
    const std::size_t source = tap / per_cell_, q = tap % per_cell_;
    const std::size_t at = source == 0 ? 0 : 1 + column_[first_column_[slot] + source - 1];
    return tap_place_[neighbours_[slot / L]][at * per_cell_ + q];
  }

  void align_neighbours();
  void lay_out_weights();
  void find_sources();
  void add_source(std::size_t block, std::size_t column);
  bool reads_the_two_before(std::size_t block) const;
  void set_arguments();
  void point_at_links();
  void invert(std::size_t at, std::uint64_t norm);

  const Plan& plan_;
  const Layout& layout_;
  const KernelSet& kernels_;
  const std::size_t per_cell_;
  const int norm_bits_;
  std::atomic<std::uint32_t> largest_row_{0};
  std::vector<std::uint32_t> neighbours_;
  std::vector<std::uint32_t> first_column_; ///< of a slot, in `column_`
  std::vector<std::uint16_t> column_;       ///< in which a cell's k-th neighbour stands in its block
  std::vector<std::vector<std::uint32_t>> tap_place_; ///< by neighbours of a block: place of a tap in its row
  std::vector<std::size_t> first_weight_;
  std::vector<std::uint32_t> first_source_, far_slot_;
  std::vector<Source> source_;
  std::vector<std::uint8_t> waits_;
  AlignedVector<std::uint32_t> weight_;
  AlignedVector<std::int32_t> bias_, state_, kept_state_;
  AlignedVector<std::int64_t> multiplier_;
  AlignedVector<std::uint32_t> xy_, zz_, next_xy_, next_zz_, kept_xy_, kept_zz_;
  KernelArgs args_{};
  FireKernel fire_ = nullptr;
};

// Where each tap of a row stands, counted in 16-bit codes from the lane's first: kernel.h has the order.
void FastCore::lay_out_weights() {
  first_weight_.assign(1, 0);
  for (std::uint32_t& even : neighbours_) {
    if (per_cell_ == 3) even += even % 2;
    first_weight_.push_back(first_weight_.back() + per_cell_ * pairs(even) * L);
    if (tap_place_.size() <= even) tap_place_.resize(even + 1);
    auto& place = tap_place_[even];
    if (!place.empty()) continue;
    const auto code = [&](std::size_t pair, std::size_t half) {
      return static_cast<std::uint32_t>(2 * L * per_cell_ * pair + half);
    };
    const bool with_z = per_cell_ == 3;
    for (std::size_t q = 0; q < per_cell_; ++q)
      place.push_back(q < 2 ? code(pairs(even) - 1, q) : code(pairs(even) - 2, 0));
    for (std::size_t k = 0; k < even; ++k)
      for (std::size_t q = 0; q < per_cell_; ++q)
        place.push_back(q == 2 ? code(k / 2 * 3 + 2, k % 2) : code(with_z ? k / 2 * 3 + k % 2 : k, q));
  }
}

void FastCore::find_sources() {
  first_source_.assign(1, 0);
  for (std::size_t b = 0; b < neighbours_.size(); ++b) {
    for (std::size_t k = 0; k < neighbours_[b]; ++k) add_source(b, k);
    waits_.push_back(reads_the_two_before(b));
    first_source_.push_back(static_cast<std::uint32_t>(source_.size()));
  }
}

// Sixteen lanes find a neighbour best when it is the same way off for all of them: neighbours of one distance
// in cell numbers get a column of their own, as long as that takes few more columns than the cells have
// neighbours. (Sums are exact, so their order is free.)
void FastCore::align_neighbours() {
  first_column_.assign(1, 0);
  for (std::size_t b = 0; b < layout_.blocks(); ++b) {
    std::vector<std::int64_t> ways;
    for (std::size_t l = 0; l < L; ++l)
      for (std::size_t k = 0; k < degree(b * L + l); ++k) ways.push_back(way(b * L + l, k));
    std::sort(ways.begin(), ways.end());
    ways.erase(std::unique(ways.begin(), ways.end()), ways.end());
    const std::size_t most = layout_.neighbours[b], wanted = ways.size();
    const bool aligned = wanted <= most + most / 4;
    neighbours_.push_back(static_cast<std::uint32_t>(aligned ? wanted : most));
    for (std::size_t l = 0; l < L; ++l) {
      for (std::size_t k = 0; k < degree(b * L + l); ++k) {
        const auto at = std::lower_bound(ways.begin(), ways.end(), way(b * L + l, k)) - ways.begin();
        column_.push_back(static_cast<std::uint16_t>(aligned ? at : static_cast<std::ptrdiff_t>(k)));
      }
      first_column_.push_back(static_cast<std::uint32_t>(column_.size()));
    }
  }
}

// A lane without this neighbour has weight 0 and may read anything that is there, even a word that another
// thread is writing.
void FastCore::add_source(std::size_t block, std::size_t column) {
  std::uint32_t slots[L];
  bool real[L] = {};
  std::uint32_t low = UINT32_MAX, high = 0;
  std::size_t first_real = L;
  bool together = true;
  for (std::size_t l = 0; l < L; ++l) {
    slots[l] = static_cast<std::uint32_t>(block * L + l);
    for (std::size_t k = 0; k < degree(block * L + l); ++k)
      if (column_[first_column_[block * L + l] + k] == column)
        slots[l] = neighbour(block * L + l, k), real[l] = true;
    if (!real[l]) continue;
    if (first_real == L) first_real = l;
    low = std::min(low, slots[l]), high = std::max(high, slots[l]);
    together = together && slots[l] >= l && slots[l] - l == slots[first_real] - first_real;
  }
  Source s{static_cast<std::uint32_t>(block * L), Source::together, {}};
  if (first_real < L && together) {
    s.base = slots[first_real] - static_cast<std::uint32_t>(first_real);
  } else if (first_real < L && high - low < 2 * L) {
    s.kind = Source::near;
    const std::uint32_t line = low / L * L; // a load that straddles cache lines costs two
    s.base = high - line < 2 * L ? line : low;
    for (std::size_t l = 0; l < L; ++l)
      s.lane[l] = static_cast<std::uint8_t>(real[l] ? slots[l] - s.base : 0);
  } else if (first_real < L) {
    s.kind = Source::far;
    s.base = static_cast<std::uint32_t>(far_slot_.size());
    far_slot_.insert(far_slot_.end(), slots, slots + L);
  }
  source_.push_back(s);
}

bool FastCore::reads_the_two_before(std::size_t block) const {
  for (std::size_t slot = block * L; slot < (block + 1) * L; ++slot)
    for (std::size_t k = 0; k < degree(slot); ++k) {
      const std::size_t other = neighbour(slot, k) / L;
      if (other < block && other + 2 >= block) return true;
    }
  return false;
}

void FastCore::set_arguments() {
  const spec::Formats& f = plan_.formats;
  args_.neighbours = neighbours_.data();
  args_.first_weight = first_weight_.data();
  args_.first_source = first_source_.data();
  args_.source = source_.data();
  args_.waits = waits_.data();
  args_.far_slot = far_slot_.data();
  args_.weight = weight_.data();
  args_.bias = bias_.data();
  args_.multiplier = multiplier_.data();
  args_.synchronous = synchronous();
  args_.bias_up = -plan_.bias_down;
  args_.state_fraction = f.state.fraction_bits();
  args_.one_drive = plan_.one_drive;
  const bool scaled = plan_.normaliser == spec::Normaliser::prescaled;
  if (plan_.normaliser != spec::Normaliser::divider)
    args_.drive = kernel_rounding(scaled ? plan_.scaled_down : multiplier_places(plan_), f.drive.rounding);
  else
    args_.division = kernel_division(plan_.ratio_up, f.drive.rounding);
  args_.state = state_.data();
  args_.state_rounding = kernel_rounding(f.drive.fraction_bits(), f.state.rounding);
  args_.link = kernel_rounding(plan_.link_down, f.link.rounding);
  point_at_links();
}

void FastCore::point_at_links() {
  args_.xy = xy_.data();
  args_.zz = zz_.data();
  args_.next_xy = synchronous() ? next_xy_.data() : xy_.data();
  args_.next_zz = synchronous() ? next_zz_.data() : zz_.data();
}

// r = floor(2^(B + M - 2) / N), B the bits of N: moved up to the point that the widest N would give.
void FastCore::invert(std::size_t at, std::uint64_t norm) {
  if (norm == 0) {
    multiplier_[at] = 0; // u = 0: an empty row stays as it is
  } else if (plan_.normaliser == spec::Normaliser::reciprocal) {
    const int bits = bit_length(norm);
    const std::uint64_t r = (std::uint64_t{1} << (bits + plan_.reciprocal_bits - 2)) / norm;
    multiplier_[at] = static_cast<std::int64_t>(r << (norm_bits_ - bits));
  } else {
    const double inverse = 1.0 / static_cast<double>(norm);
    std::memcpy(&multiplier_[at], &inverse, sizeof inverse);
  }
}

void FastCore::prepare(std::size_t first, std::size_t last) {
  const RowKernel rows = kernels_.rows[per_cell_ - 2];
  std::vector<std::uint32_t> sums(per_cell_ * L);
  std::uint32_t largest = 0;
  for (std::size_t b = first; b < last; ++b) {
    rows(args_, b, sums.data());
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const std::size_t at = b * per_cell_ * L + k;
      largest = std::max(largest, sums[k]);
      if (plan_.normaliser == spec::Normaliser::prescaled) continue;
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
  fire_ = kernels_.fire[per_cell_ - 2][static_cast<std::size_t>(normalise_of(plan_))][plain][wide];
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

std::unique_ptr<Core> make_fast_core(const Plan& plan, const Layout& layout, const KernelSet& kernels) {
  return std::make_unique<FastCore>(plan, layout, kernels);
}

} // namespace hopmesh::engine
