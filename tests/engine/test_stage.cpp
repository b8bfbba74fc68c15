// The output stage inside every core, in the loops of every output stage (output_stage_cases.h): all 8-bit
// states, then corners and random cases at 16, 24 and 32 bits in every mode. A neuron gets its s as a bias,
// and its N by weights from neurons that rest at zero.
#include "tests/engine/engine_bench.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/engine/choose.h"
#include "tests/support/output_stage_cases.h"

namespace hopmesh::tests {
namespace {

using engine::Layout;
using engine::NeuronPlan;
using engine::SweepCore;
using spec::Normaliser;
using spec::Rounding;

/// Many neurons that can be given any (s, N, V): cell 2 k asks, cell 2 k + 1 has no input and stays at zero.
/// Below the engine, so that N is prepared once for many V.
class Bank {
 public:
  Bank(const spec::ArraySpec& array, std::size_t neurons, const std::string& kernel)
      : array_(array), topology_(pairs((neurons + 2) / 3)), plan_(array, topology_),
        layout_(topology_, spec::phases_of(topology_, array.schedule), array.schedule),
        core_(engine::make_core(plan_, layout_, kernel)) {}

  /// s counts in the bias's last place; N = |s| + |rest| in units of max(F_weight, F_bias).
  void put(std::size_t k, std::int32_t s, std::int64_t rest) {
    std::array<std::int32_t, 6> row{};
    const std::int64_t most = array_.formats.weight.max_raw();
    for (std::size_t tap = 3; tap < 6; ++tap, rest -= std::min(rest, most))
      row[tap] = static_cast<std::int32_t>(tap % 2 ? std::min(rest, most) : -std::min(rest, most));
    core_->put_weights(slot(k), k % 3, 0, row.data(), row.size());
    core_->put_bias(slot(k), k % 3, s);
  }
  static std::int64_t most_rest(const spec::ArraySpec& a) { return 3 * a.formats.weight.max_raw(); }
  void prepare() {
    core_->prepare(0, layout_.blocks());
    core_->begin_run(false);
  }
  void put_state(std::size_t k, std::int64_t V) {
    core_->put_state(slot(k), k % 3, static_cast<std::int32_t>(V));
  }
  void fire() { core_->fire(0, layout_.blocks(), {}, record); }
  std::int64_t state(std::size_t k) const { return core_->state(slot(k), k % 3); }

  engine::SweepRecord record;

 private:
  static spec::Topology pairs(std::size_t count) {
    Edges edges;
    for (std::uint32_t k = 0; k < count; ++k) edges.push_back({2 * k, 2 * k + 1});
    return topology_of(2 * count, 3, edges);
  }
  std::size_t slot(std::size_t k) const { return layout_.slot_of_cell[k / 3 * 2]; }

  const spec::ArraySpec array_;
  const spec::Topology topology_;
  const NeuronPlan plan_;
  const Layout layout_;
  const std::unique_ptr<SweepCore> core_;
};

/// An array for the kernels with this stage, `finer` places of the bias behind the weights', and of weights
/// and biases the widest that still are a case for the kernels. Two things no kernel has, and the drive stays
/// away from them: rounding to even behind a divider, and prescaled rows coarser than the drive.
spec::ArraySpec array_for_stage(const spec::NumberFormat& stage, Normaliser normaliser, int finer,
                                spec::Output output = spec::Output::modified) {
  spec::ArraySpec a;
  a.normaliser = normaliser;
  a.output = output;
  a.formats.drive = a.formats.state = stage;
  if (normaliser == Normaliser::divider && stage.rounding == Rounding::rnd_conv)
    a.formats.drive.rounding = Rounding::trn_zero;
  if (normaliser == Normaliser::prescaled) a.formats.drive.width = std::min(stage.width, 24);
  a.formats.link = {std::min(stage.width, 16), 2, stage.rounding, stage.overflow};
  const spec::Topology pair = topology_of(2, 3, {{0, 1}});
  for (int weight = 16; weight >= 4; --weight)
    for (int bias = 32; bias > weight + finer; --bias) {
      a.formats.weight = {weight, 1, Rounding::rnd, spec::Overflow::sat};
      a.formats.bias = {bias, bias - (weight - 1 + finer), Rounding::rnd, spec::Overflow::sat};
      if (!spec::validate(a, 6) && why_not_fast(a, pair).empty()) return a;
    }
  ADD_FAILURE() << "no kernel for " << stage.text() << " behind " << name_of(normaliser);
  return a;
}

/// What the bit-serial neuron makes of V under u, for all 8-bit V and u: there are few.
struct AllChanges {
  explicit AllChanges(const spec::Formats& f) : one(f.state.one_raw()) {
    for (std::int64_t v = -one; v <= one; ++v)
      for (std::int64_t u = -one; u <= one; ++u)
        next.push_back(static_cast<std::int8_t>(v + change(f, v, u)));
  }
  std::int64_t after(std::int64_t v, std::int64_t u) const {
    return next[static_cast<std::size_t>((v + one) * (2 * one + 1) + u + one)];
  }
  const std::int64_t one;
  std::vector<std::int8_t> next;
};

/// All (s, N), N = 1 ... most; then every V on all of them at once.
std::uint64_t run_all_eight_bit_states(const spec::ArraySpec& array, const std::string& kernel,
                                       std::int64_t most) {
  const auto pairs = static_cast<std::size_t>(most * (most + 2));
  Bank bank(array, pairs, kernel);
  const AllChanges changes(array.formats);
  const auto accumulator = spec::accumulator_format(array, 6);
  const int up = accumulator.fraction_bits() - array.formats.bias.fraction_bits();
  std::vector<std::int8_t> u;
  for (std::int64_t n = 1; n <= most; ++n)
    for (std::int64_t s = -n; s <= n; ++s) {
      bank.put(u.size(), static_cast<std::int32_t>(s), n - std::abs(s));
      u.push_back(static_cast<std::int8_t>(drive(array, accumulator, s << up, static_cast<Wide>(n))));
    }
  EXPECT_EQ(u.size(), pairs);
  bank.prepare();
  std::uint64_t cases = 0, mismatches = 0;
  for (std::int64_t v = -changes.one; v <= changes.one; ++v) {
    for (std::size_t k = 0; k < pairs; ++k) bank.put_state(k, v);
    bank.fire();
    for (std::size_t k = 0; k < pairs; ++k) mismatches += bank.state(k) != changes.after(v, u[k]);
    cases += pairs;
  }
  EXPECT_EQ(mismatches, 0u) << kernel;
  return cases;
}

class AllEightBitStatesOnKernels : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(AllEightBitStatesOnKernels, AgreeWithTheBitSerialNeuron) {
  const auto [normaliser, rounding] = GetParam();
  const spec::ArraySpec array = array_for_stage({8, 2, static_cast<Rounding>(rounding), spec::Overflow::sat},
                                                static_cast<Normaliser>(normaliser), 0);
  for (const std::string& kernel : kernels_here())
    EXPECT_EQ(run_all_eight_bit_states(array, kernel, 255), 129u * 255 * 257);
}

INSTANTIATE_TEST_SUITE_P(DividerAndReciprocal, AllEightBitStatesOnKernels,
                         testing::Combine(testing::Values(1, 2),
                                          testing::Values(int(Rounding::rnd), int(Rounding::trn_zero))));

/// The case that a bank can have and that comes nearest to the wanted one.
struct Realised {
  std::int32_t s;
  std::int64_t rest, n;
  Realised(const StageCase& c, const spec::ArraySpec& a, int finer)
      : s(static_cast<std::int32_t>(
            std::min(std::max(c.s, a.formats.bias.min_raw()), a.formats.bias.max_raw()))),
        rest(std::min((std::max<std::int64_t>(c.n - std::abs(c.s), 0) + (1 << finer) - 1) >> finer,
                      Bank::most_rest(a))),
        n(std::abs(std::int64_t{s}) + (rest << finer)) {}
};

/// Cases for all kernels at once, in banks; the judge says what to expect once for all of them.
class WideStage {
 public:
  WideStage(const spec::ArraySpec& array, int finer)
      : array_(array), finer_(finer), accumulator_(spec::accumulator_format(array, 6)),
        up_(accumulator_.fraction_bits() - array.formats.bias.fraction_bits()) {
    for (const std::string& kernel : kernels_here())
      banks_.push_back(std::make_unique<Bank>(array, size, kernel));
  }

  void add(const StageCase& c) {
    const Realised r(c, array_, finer_);
    if (r.n == 0) return;
    const std::int64_t s = std::int64_t{r.s} << up_,
                       u = drive(array_, accumulator_, s, static_cast<Wide>(r.n));
    for (auto& bank : banks_) {
      bank->put(expected_.size(), r.s, r.rest);
      bank->put_state(expected_.size(), c.v);
    }
    told_.push_back({c.v, s, r.n});
    expected_.push_back(c.v + change(array_.formats, c.v, u));
    least_drive_ = std::min(least_drive_, u), largest_drive_ = std::max(largest_drive_, u);
    if (expected_.size() == size) judge();
  }

  void judge() {
    for (std::size_t b = 0; b < banks_.size(); ++b) {
      banks_[b]->prepare();
      banks_[b]->fire();
      for (std::size_t k = 0; k < expected_.size() && !testing::Test::HasFailure(); ++k)
        EXPECT_EQ(banks_[b]->state(k), expected_[k])
            << kernels_here()[b] << ": V " << told_[k].v << ", s " << told_[k].s << ", N " << told_[k].n;
    }
    cases += expected_.size();
    expected_.clear();
    told_.clear();
  }

  /// u itself is seen only by its swings.
  void expect_drives() const {
    for (const auto& bank : banks_) {
      EXPECT_EQ(bank->record.all_extremes().least_drive, least_drive_);
      EXPECT_EQ(bank->record.all_extremes().largest_drive, largest_drive_);
    }
  }

  std::uint64_t cases = 0;

 private:
  static constexpr std::size_t size = 3 * 512;
  const spec::ArraySpec array_;
  const int finer_;
  const spec::NumberFormat accumulator_;
  const int up_;
  std::vector<std::unique_ptr<Bank>> banks_;
  std::vector<std::int64_t> expected_;
  std::vector<StageCase> told_;
  std::int64_t least_drive_ = 0, largest_drive_ = 0;
};

void run_corners_then_random(const spec::ArraySpec& array, int finer, std::uint64_t seed,
                             std::uint64_t cases) {
  SCOPED_TRACE("seed " + std::to_string(seed) + ", drive " + array.formats.drive.text());
  Dice dice(seed);
  WideStage test(array, finer);
  const auto corners = stage_corners(array);
  const std::size_t stride = 1 + corners.size() * 2 / cases; // half of the cases are corners
  for (std::size_t k = dice.below(stride); k < corners.size(); k += stride) test.add(corners[k]);
  while (test.cases < cases) test.add(random_stage_case(dice, array));
  test.judge();
  test.expect_drives();
}

class WideStagesOnKernels : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(WideStagesOnKernels, CornersThenRandom) {
  const auto [width, normaliser] = GetParam();
  std::uint64_t seed = static_cast<std::uint64_t>(100 * width + 30 * normaliser);
  for (int rounding = 0; rounding < 7; ++rounding)
    for (int finer : {0, 4, 8}) {
      const spec::NumberFormat stage{width, 2, static_cast<Rounding>(rounding), spec::Overflow::sat};
      run_corners_then_random(array_for_stage(stage, static_cast<Normaliser>(normaliser), finer), finer,
                              ++seed, 10000000 / 189 + 1);
    }
}

INSTANTIATE_TEST_SUITE_P(EveryMode, WideStagesOnKernels,
                         testing::Combine(testing::Values(16, 24, 32), testing::Range(0, 3)));

TEST(BinaryStageOnKernels, CornersThenRandom) {
  for (int width : {8, 16, 24, 32})
    for (int rounding = 0; rounding < 7; ++rounding) {
      const spec::NumberFormat stage{width, 2, static_cast<Rounding>(rounding), spec::Overflow::sat};
      run_corners_then_random(array_for_stage(stage, Normaliser::reciprocal, 4, spec::Output::binary), 4,
                              static_cast<std::uint64_t>(1000 + 10 * width + rounding), 40000);
    }
}

} // namespace
} // namespace hopmesh::tests
