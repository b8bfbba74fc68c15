// The array `descent` in SystemC: in exact integer arithmetic, the network's energy falls or stays in every
// sweep, whatever the symmetric network. And the one order in which nothing is promised: all at once.
#include "rtl_model/spec/array_keys.h"
#include "rtl_model/spec/presets.h"
#include "tests/support/dut_job.h"
#include "tests/support/random_network.h"

#include <gtest/gtest.h>
#include <memory>

namespace hopmesh::tests {
namespace {

__extension__ typedef __int128 Wide;
using Codes = std::vector<std::int32_t>;

/// Calls visit(cell, p, other, q) for every weight there is.
template <typename Visit> void for_each_weight(const spec::Topology& t, Visit visit) {
  const std::size_t n = t.neurons_per_cell;
  for (std::size_t c = 0; c < t.cells(); ++c)
    for (std::size_t k = 0; k <= t.degree(c); ++k)
      for (std::size_t p = 0; p < n; ++p)
        for (std::size_t q = 0; q < n; ++q) visit(c, p, k == 0 ? c : t.link_to[t.first_link[c] + k - 1], q);
}

void make_symmetric(ArrayJob& job) {
  const spec::Topology& t = job.topology;
  for_each_weight(t, [&](std::size_t c, std::size_t p, std::size_t d, std::size_t q) {
    job.weight[weight_word(t, d, q, c, p)] = job.weight[weight_word(t, c, p, d, q)];
  });
}

/// Twice the energy, -V'WV - 2 I'V, in units of the weight's last place times the square of the state's.
Wide energy(const ArrayJob& job, const Codes& V) {
  const spec::Topology& t = job.topology;
  const std::size_t n = t.neurons_per_cell;
  Wide sum = 0;
  for_each_weight(t, [&](std::size_t c, std::size_t p, std::size_t d, std::size_t q) {
    sum -= Wide{job.weight[weight_word(t, c, p, d, q)]} * V[c * n + p] * V[d * n + q];
  });
  for (std::size_t i = 0; i < V.size(); ++i)
    sum -= 2 * Wide{job.bias[i]} * V[i] * job.array.formats.state.one_raw();
  return sum;
}

/// In every other network, neurons that hold themselves back (w_ii far below zero): there a step too far
/// costs most.
void hold_back(Dice& dice, ArrayJob& job) {
  if (dice.one_in(2)) return;
  const std::size_t n = job.topology.neurons_per_cell;
  for (auto& w : job.weight) w /= 64;
  for (auto& bias : job.bias) bias /= 1 << 16;
  for (std::size_t i = 0; i < job.topology.neurons(); ++i)
    job.weight[weight_word(job.topology, i / n, i % n, i / n, i % n)] = -32768;
}

/// `descent` with other widths, either normaliser that keeps the proof, either order.
spec::ArraySpec descending_array(Dice& dice) {
  spec::ArraySpec a = spec::descent_array();
  const int width = static_cast<int>(dice.between(6, 24));
  for (auto* format : {&a.formats.state, &a.formats.link}) format->width = width;
  a.formats.drive.width = static_cast<int>(dice.between(6, 24));
  if (dice.one_in(2)) a.normaliser = spec::Normaliser::reciprocal;
  if (dice.one_in(3)) a.schedule = spec::Schedule::sequential;
  return a;
}

ArrayJob descending_job(std::uint64_t seed) {
  Dice dice(seed);
  const spec::ArraySpec array = descending_array(dice);
  ArrayJob job = random_codes(dice, array, random_topology(dice, 25));
  make_symmetric(job);
  hold_back(dice, job);
  for (auto& V : job.start) // as the device will hold it
    V = static_cast<std::int32_t>(
        std::clamp<std::int64_t>(V, -array.formats.state.one_raw(), array.formats.state.one_raw()));
  return job;
}

/// A device for each job: all are built before the first one runs.
std::vector<std::unique_ptr<Dut>> duts_for(const std::vector<ArrayJob>& jobs) {
  std::vector<std::unique_ptr<Dut>> duts;
  for (const ArrayJob& job : jobs)
    duts.push_back(
        std::make_unique<Dut>(("dut" + std::to_string(duts.size())).c_str(), job.array, job.topology));
  return duts;
}

TEST(CosimDescent, EnergyNeverRisesInAnySweep) {
  constexpr std::uint64_t jobs = 300;
  std::vector<ArrayJob> all;
  for (std::uint64_t seed = 1; seed <= jobs; ++seed) all.push_back(descending_job(seed));
  const auto duts = duts_for(all);
  std::size_t falls = 0;
  for (std::size_t k = 0; k < jobs; ++k) {
    SCOPED_TRACE("seed " + std::to_string(k + 1) + ": " + describe(all[k]));
    load(*duts[k], all[k]);
    Wide before = energy(all[k], all[k].start);
    for (int sweep = 0; sweep < 20; ++sweep) {
      duts[k]->start(0, 1); // one sweep from where the last one ended
      duts[k]->run_until_done();
      const Wide now = energy(all[k], duts[k]->codes(Window::OUTPUT, all[k].topology.neurons()));
      ASSERT_TRUE(now <= before) << "sweep " << sweep;
      falls += now < before;
      before = now;
    }
  }
  EXPECT_GT(falls, 10 * jobs / 2); // it is not that nothing moves
}

// ---- the stages that step further: in their presets, the energy falls too

/// With other widths, normalisers, and omega, as the proof allows.
ArrayJob stepping_job(std::uint64_t seed, spec::ArraySpec array) {
  Dice dice(seed);
  const spec::ArraySpec widths = descending_array(dice);
  array.formats = widths.formats;
  array.normaliser = widths.normaliser;
  if (array.output == spec::Output::projected) array.schedule = widths.schedule;
  array.relaxation = static_cast<int>(dice.between(1, spec::most_relaxation));
  ArrayJob job = random_codes(dice, array, random_topology(dice, 25));
  make_symmetric(job);
  hold_back(dice, job);
  if (dice.one_in(3)) std::fill(job.bias.begin(), job.bias.end(), 0);
  job.momentum.assign(cosim::table_entries(array), 0); // as the driver's sequence begins
  const std::int64_t one = array.formats.state.one_raw();
  for (auto& V : job.start) V = static_cast<std::int32_t>(std::clamp<std::int64_t>(V, -one, one));
  return job;
}

class CosimDescentStepping : public testing::TestWithParam<const char*> {};

TEST_P(CosimDescentStepping, EnergyNeverRisesInAnySweep) {
  constexpr std::uint64_t jobs = 150;
  std::vector<ArrayJob> all;
  for (std::uint64_t seed = 1; seed <= jobs; ++seed)
    all.push_back(stepping_job(seed, *spec::preset(GetParam())));
  const auto duts = duts_for(all);
  std::size_t falls = 0;
  for (std::size_t k = 0; k < jobs; ++k) {
    SCOPED_TRACE("seed " + std::to_string(k + 1) + ": " + describe(all[k]));
    Wide before = energy(all[k], all[k].start);
    for (std::uint32_t sweeps = 1; sweeps <= 12; ++sweeps) { // a whole run each, from the start
      load(*duts[k], all[k]);
      duts[k]->start(0, sweeps);
      duts[k]->run_until_done();
      const Wide now = energy(all[k], duts[k]->codes(Window::OUTPUT, all[k].topology.neurons()));
      ASSERT_TRUE(now <= before) << "sweep " << sweeps;
      falls += now < before;
      before = now;
    }
  }
  EXPECT_GT(falls, 3 * jobs); // it is not that nothing moves
}

std::string name_of_preset(const testing::TestParamInfo<const char*>& param) {
  return param.param == std::string("descent-momentum") ? "momentum" : "projected";
}
INSTANTIATE_TEST_SUITE_P(Presets, CosimDescentStepping,
                         testing::Values("descent-projected", "descent-momentum"), name_of_preset);

/// What the paper's stage does for ever when all fire at once: W = [[0, -1], [-1, 0]], V = (1, 1). Here N = 1
/// bounds the step, and both meet at 0.
TEST(CosimDescent, MomentumEndsWhereTheModifiedStageGoesRound) {
  ArrayJob job;
  job.array = spec::descent_momentum_array();
  job.topology = topology_of(2, 1, {{0, 1}});
  const std::int32_t one = static_cast<std::int32_t>(job.array.formats.state.one_raw());
  job.weight = {0, -32768, 0, -32768}; // own tap, then the neighbour's
  job.bias = {0, 0};
  job.start = {one, one};
  const auto duts = duts_for({job});
  load(*duts[0], job);
  duts[0]->start(0, 50);
  duts[0]->run_until_done();
  EXPECT_LT(energy(job, duts[0]->codes(Window::OUTPUT, 2)), energy(job, job.start));
  EXPECT_TRUE(duts[0]->read(HM_REG_STATUS) & HM_STATUS_CONVERGED);
  EXPECT_EQ(duts[0]->codes(Window::OUTPUT, 2), (Codes{0, 0}));
}

/// Binary outputs, w_ii >= 0 everywhere, starts anywhere in the box.
ArrayJob binary_job(std::uint64_t seed) {
  ArrayJob job = descending_job(seed);
  job.array.output = spec::Output::binary;
  const auto n = static_cast<std::size_t>(job.topology.neurons_per_cell);
  for (std::size_t i = 0; i < job.topology.neurons(); ++i) {
    std::int32_t& own = job.weight[weight_word(job.topology, i / n, i % n, i / n, i % n)];
    own = std::min(std::abs(own), 32767);
  }
  return job;
}

TEST(CosimDescent, BinaryEnergyFallsWithEveryFlipUntilNothingMoves) {
  constexpr std::uint64_t jobs = 300;
  std::vector<ArrayJob> all;
  for (std::uint64_t seed = 1001; seed <= 1000 + jobs; ++seed) all.push_back(binary_job(seed));
  const auto duts = duts_for(all);
  std::size_t falls = 0;
  for (std::size_t k = 0; k < jobs; ++k) {
    SCOPED_TRACE("seed " + std::to_string(k + 1001) + ": " + describe(all[k]));
    load(*duts[k], all[k]);
    Codes V = all[k].start;
    bool moved = true;
    for (int sweep = 0; moved; ++sweep) {
      ASSERT_LT(sweep, 1000);
      duts[k]->start(0, 1);
      duts[k]->run_until_done();
      const Codes now = duts[k]->codes(Window::OUTPUT, all[k].topology.neurons());
      moved = now != V;
      ASSERT_TRUE(!moved || energy(all[k], now) < energy(all[k], V)) << "sweep " << sweep;
      ASSERT_EQ(duts[k]->read(HM_REG_LARGEST_CHANGE) != 0, moved);
      falls += moved;
      V = now;
    }
  }
  EXPECT_GT(falls, jobs);
}

/// W = -1, I = 1/2: E(V) = V^2 / 2 - V / 2. V = 1 has s = -1/2 and goes up to E = 1; V = -1 has s = 3/2 and
/// comes back. For a sign, the step of 2 is too far as soon as w_ii < 0.
TEST(CosimDescent, ABinaryNeuronThatHoldsItselfBackFlipsForEverAlone) {
  const spec::Topology alone = topology_of(1, 1, {});
  spec::ArraySpec array = spec::descent_array();
  array.output = spec::Output::binary;
  const ArrayJob job{array, alone, {-32768}, {16384}, {16384}, 0, 1};
  Dut dut("dut", array, alone);
  load(dut, job);
  Codes V = job.start;
  for (int sweep = 0; sweep < 6; ++sweep) {
    dut.start(0, 1);
    dut.run_until_done();
    const Codes now = dut.codes(Window::OUTPUT, 1);
    EXPECT_EQ(now[0], sweep % 2 == 0 ? -16384 : 16384);
    EXPECT_EQ(energy(job, now) > energy(job, V), sweep % 2 == 0);
    V = now;
  }
}

/// The two neurons of the next test, with binary outputs and a cell each.
TEST(CosimDescent, AllAtOnceTwoBinaryNeuronsFlipForEver) {
  const spec::Topology pair = topology_of(2, 1, {{0, 1}});
  spec::ArraySpec together = spec::descent_array(), in_turn = together;
  together.output = in_turn.output = spec::Output::binary;
  together.schedule = spec::Schedule::synchronous;
  const ArrayJob job{together, pair, {0, -32768, 0, -32768}, {0, 0}, {16384, 16384}, 0, 1};
  Dut flipping("flipping", together, pair), resting("resting", in_turn, pair);
  load(flipping, job);
  load(resting, job);
  for (int sweep = 0; sweep < 6; ++sweep) {
    flipping.start(0, 1);
    flipping.run_until_done();
    const int V = sweep % 2 == 0 ? -16384 : 16384;
    EXPECT_EQ(flipping.codes(Window::OUTPUT, 2), (Codes{V, V})) << sweep;
    EXPECT_EQ(flipping.read(HM_REG_LARGEST_CHANGE), 32768u);
  }
  resting.start(0, 100);
  resting.run_until_done();
  EXPECT_EQ(resting.read(HM_REG_STATUS), static_cast<std::uint32_t>(HM_STATUS_DONE | HM_STATUS_CONVERGED));
  EXPECT_EQ(resting.read(HM_REG_SWEEPS), 2u);
  EXPECT_EQ(resting.codes(Window::OUTPUT, 2), (Codes{-16384, 16384}));
}

/// W = [[0, -1], [-1, 0]], I = 0, V = (1, 1): all at once it flips to (-1, -1) and back for ever; one at a
/// time it rests.
TEST(CosimDescent, AllAtOnceTwoNeuronsFlipForEver) {
  const spec::Topology pair = topology_of(2, 2, {{0, 1}});
  spec::ArraySpec together = spec::descent_array(), in_turn = together;
  together.schedule = spec::Schedule::synchronous;
  ArrayJob job{together, pair, Codes(pair.weight_words(), 0), Codes(4, 0), {16384, 0, 16384, 0}, 0, 1};
  job.weight[weight_word(pair, 0, 0, 1, 0)] = job.weight[weight_word(pair, 1, 0, 0, 0)] = -32768;
  Dut flipping("flipping", together, pair), resting("resting", in_turn, pair);
  load(flipping, job);
  load(resting, job);
  for (int sweep = 0; sweep < 6; ++sweep) {
    flipping.start(0, 1);
    flipping.run_until_done();
    const int V = sweep % 2 == 0 ? -16384 : 16384;
    EXPECT_EQ(flipping.codes(Window::OUTPUT, 4), (Codes{V, 0, V, 0})) << sweep;
  }
  resting.start(0, 100);
  resting.run_until_done();
  EXPECT_EQ(resting.read(HM_REG_STATUS), static_cast<std::uint32_t>(HM_STATUS_DONE | HM_STATUS_CONVERGED));
  EXPECT_EQ(resting.codes(Window::OUTPUT, 4), (Codes{-16384, 0, 16384, 0}));
}

} // namespace
} // namespace hopmesh::tests
