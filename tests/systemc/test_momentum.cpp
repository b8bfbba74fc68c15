// A momentum array behind its bus, by phase and by clock, unfolded and folded: its table, the restart, what a
// START and a host's write do to Y.
#include "tests/systemc/every_way.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hopmesh::tests {
namespace {

using Codes = std::vector<std::int32_t>;

spec::ArraySpec momentum_array(int entries) {
  spec::ArraySpec a = spec::descent_momentum_array();
  a.momentum_entries = entries;
  a.packing = true;
  return a;
}

/// A neuron alone: w_ii = -1/2, so N = 1/2, and I = 1/8 of the same unit. With Q = 2^14 codes of 1:
/// s = -Y / 2 + I, u = 2 s, V' = Y + u = 2 I = 1/4 at once, whatever Y is.
struct Alone {
  spec::ArraySpec array = momentum_array(3);
  spec::Topology topology = topology_of(1, 1, {});
  static constexpr std::int32_t one = 16384;
  void load(Dut& dut, const Codes& table) const {
    dut.put_codes(Window::WEIGHT, {-16384});
    dut.put_codes(Window::BIAS, {4096});
    dut.put_codes(Window::OUTPUT, {0});
    dut.put_codes(Window::MOMENTUM, table);
  }
};

std::int32_t link_of(Dut& dut) {
  return dut.device.cells.link_raw(0);
}

TEST(Momentum, LinksCarryYAndOutputShowsV) {
  const Alone alone;
  const auto duts = every_way(alone.array, alone.topology);
  for (const auto& dut : duts) {
    alone.load(*dut, {16384, 0, 0}); // m = 1/2 in the first sweep
    dut->start(0, 1);
    dut->run_until_done();
    EXPECT_EQ(dut->codes(Window::OUTPUT, 1), Codes{4096});
    EXPECT_EQ(link_of(*dut), 4096 + 2048); // half of the move from 0 ahead
    dut->start(0, 1);                      // begins at V again
    dut->run_until_done();
    EXPECT_EQ(dut->read(HM_REG_LARGEST_CHANGE), 0u);
    EXPECT_EQ(link_of(*dut), 4096);
    dut->put_codes(Window::OUTPUT, {-8192});
    EXPECT_EQ(link_of(*dut), -8192);
  }
}

/// From Y = 3/8 the step leads back to 1/4, where V is already: no change, so m does not matter.
TEST(Momentum, GoesOnFromY) {
  const Alone alone;
  const auto duts = every_way(alone.array, alone.topology);
  for (const auto& dut : duts) {
    alone.load(*dut, {16384, 32767, 32767});
    dut->start(0, 2);
    dut->run_until_done();
    EXPECT_EQ(dut->read(HM_REG_SWEEPS), 2u);
    EXPECT_EQ(dut->read(HM_REG_LARGEST_CHANGE), 0u);
    EXPECT_EQ(link_of(*dut), 4096);
  }
}

/// In plain numbers: the whole run of a small symmetric network, restarts and all.
struct Plain {
  std::vector<double> w; // 4 x 4
  std::vector<double> bias, V, Y;
  std::size_t restarts = 0;

  void run(const std::vector<double>& m, int sweeps) {
    const std::size_t n = bias.size();
    Y = V;
    std::size_t k = 0;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      double way = 0;
      std::vector<double> next = Y, before = V;
      for (std::size_t i = 0; i < n; ++i) {
        double s = bias[i], N = 0;
        for (std::size_t j = 0; j < n; ++j) s += w[i * n + j] * Y[j], N += std::abs(w[i * n + j]);
        V[i] = std::clamp(Y[i] + std::clamp(s / N, -1.0, 1.0), -1.0, 1.0);
        way += (s > 0 ? 1 : s < 0 ? -1 : 0) * (V[i] - before[i]);
        next[i] = std::clamp(V[i] + m[k] * (V[i] - before[i]), -1.0, 1.0);
      }
      Y = way < 0 ? V : next;
      restarts += way < 0;
      k = std::min((way < 0 ? 0 : k) + 1, m.size() - 1);
    }
  }
};

TEST(Momentum, FollowsTheMathematicsThroughRestarts) {
  spec::ArraySpec array = momentum_array(6);
  array.formats.weight = {24, 1, spec::Rounding::rnd, spec::Overflow::sat};
  array.formats.bias = {24, 1, spec::Rounding::rnd, spec::Overflow::sat};
  for (auto* f : {&array.formats.drive, &array.formats.state, &array.formats.link})
    *f = {28, 2, spec::Rounding::rnd, spec::Overflow::sat};
  const spec::Topology ring = ring_topology(4, 1); // each joined to two others
  const auto duts = every_way(array, ring);
  Dice dice(5);
  std::size_t restarts = 0, trials = 0;
  const Codes table{0, 9000, 16000, 22000, 28000, 32000};
  const std::vector<double> m = [&] {
    std::vector<double> values(table.begin(), table.end());
    for (double& value : values) value /= 32768;
    return values;
  }();
  for (int trial = 0; trial < 12; ++trial) {
    Plain plain{std::vector<double>(16, 0), {}, {}, {}};
    Codes weights(ring.weight_words()), bias, start;
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t k = 0; k <= ring.degree(c); ++k) {
        const std::size_t d = k == 0 ? c : ring.link_to[ring.first_link[c] + k - 1];
        if (d < c) continue;
        const auto w = static_cast<std::int32_t>(d == c ? dice.between(-4000000, -2500000)
                                                        : dice.between(800000, 1300000));
        weights[weight_word(ring, c, 0, d, 0)] = weights[weight_word(ring, d, 0, c, 0)] = w;
        plain.w[c * 4 + d] = plain.w[d * 4 + c] = w * 0x1p-23;
      }
    for (std::size_t i = 0; i < 4; ++i) {
      bias.push_back(static_cast<std::int32_t>(dice.between(-600000, 600000)));
      start.push_back(static_cast<std::int32_t>(dice.between(-30000000, 30000000)));
      plain.bias.push_back(bias.back() * 0x1p-23);
      plain.V.push_back(start.back() * 0x1p-26);
    }
    plain.run(m, 25);
    restarts += plain.restarts, trials += 1;
    for (const auto& dut : duts) {
      dut->put_codes(Window::WEIGHT, weights);
      dut->put_codes(Window::BIAS, bias);
      dut->put_codes(Window::OUTPUT, start);
      dut->put_codes(Window::MOMENTUM, table);
      dut->start(0, 25);
      dut->run_until_done();
      const Codes V = dut->codes(Window::OUTPUT, 4);
      for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(V[i] * 0x1p-26, plain.V[i], 1e-5) << trial << " " << i;
    }
  }
  EXPECT_GT(restarts, trials / 2); // it is not that none restarted
}

TEST(Momentum, AResetEmptiesTheTableAndTakesItsTime) {
  const Alone alone;
  spec::ArraySpec array = alone.array;
  array.momentum_entries = 41;
  Dut dut("dut", array, alone.topology);
  alone.load(dut, {1, 2, 3});
  EXPECT_EQ(dut.codes(Window::MOMENTUM, 3), (Codes{1, 2, 3}));
  dut.put_codes(Window::MOMENTUM, {-32768, 32767});
  EXPECT_EQ(dut.codes(Window::MOMENTUM, 3), (Codes{-32768, 32767, 3}));
  dut.command(HM_CONTROL_RESET);
  dut.run_to_cycle(40);
  EXPECT_TRUE(dut.read(HM_REG_STATUS) & HM_STATUS_BUSY);
  dut.run_to_cycle(41);
  EXPECT_FALSE(dut.read(HM_REG_STATUS) & HM_STATUS_BUSY);
  EXPECT_EQ(dut.codes(Window::MOMENTUM, 41), Codes(41, 0));
}

} // namespace
} // namespace hopmesh::tests
