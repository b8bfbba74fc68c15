// Steps in whole numbers beside the same steps in double: networks, rest, energies, motion, and what is
// refused.
#include "sim/levels/array_mover.h"
#include "sim/levels/hosts/native_fixed_host.h"
#include "sim/levels/prepared.h"
#include "sim/reference/rest.h"
#include "tests/support/complaint.h"
#include "tests/support/small_scenes.h"
#include "tests/support/soft_array.h"

#include "rtl_model/spec/presets.h"
#include "sim/engine/engine.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/ports/engine_port.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using levels::StepMemory;
using ::testing::HasSubstr;

double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double squares = 0;
  for (std::size_t k = 0; k < a.size(); ++k) squares += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(squares / static_cast<double>(a.size()));
}

double rms(const std::vector<double>& a) {
  return rms(a, std::vector<double>(a.size()));
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// A host with an array and a memory of its own.
template <typename Host> struct Side {
  Side(const scene::Scene& s, const levels::BuiltMesh& mesh, const spec::ArraySpec& array)
      : relax(s.relax), motion(levels::step_parameters(s)), memory(mesh),
        port(array, mesh.topology(), {}, {}, levels::stop_requested),
        host({port, mesh.firmware(), motion, relax, memory}) {
    EXPECT_EQ(host.open(), HM_OK);
  }
  int step() {
    result = {};
    return host.step(result);
  }

  const scene::RelaxSpec relax;
  const hm_step_parameters motion;
  StepMemory memory;
  levels::EnginePort port;
  Host host;
  levels::HostStep result;
};

/// Two hosts do each step, in double and in whole numbers, from where the doubles got to.
struct Pair {
  Pair(const scene::Scene& s, const spec::ArraySpec& a)
      : mesh(s), array(a), exact(s, mesh, a), whole(s, mesh, a) {}

  void step() {
    const auto from = levels::parts_of(exact.memory.now);
    const auto to = levels::parts_of(whole.memory.now);
    for (std::size_t k = 0; k < to.size(); ++k)
      std::copy(from[k].second->begin(), from[k].second->end(), to[k].second->begin());
    whole.memory.state.step = exact.memory.state.step;
    ASSERT_EQ(exact.step(), HM_OK);
    ASSERT_EQ(whole.step(), HM_OK);
  }

  /// The rest of a side's network as the array has it, in codes.
  template <typename Host> std::vector<double> rest(const Side<Host>& side) const {
    const StepMemory& m = side.memory;
    const hm_driver& d = side.host.driver();
    const auto coded = [&](const std::vector<double>& values, const hm_format& format) {
      std::vector<double> all(values.size());
      for (std::size_t k = 0; k < values.size(); ++k) {
        int clipped = 0;
        all[k] = std::ldexp(hm_quantise(values[k], d.shift, &format, &clipped), -hm_fraction_bits(&format));
      }
      return all;
    };
    const std::vector<double> weight = coded(m.weight, d.weight), bias = coded(m.bias, d.bias);
    const auto size = static_cast<Eigen::Index>(mesh.nodes() * mesh.components());
    reference::Network network;
    std::vector<Eigen::Triplet<double>> entries;
    mesh.each_weight([&](std::size_t at, std::size_t row, std::size_t column) {
      entries.emplace_back(row, column, weight[at]);
    });
    network.W.resize(size, size);
    network.W.setFromTriplets(entries.begin(), entries.end());
    const std::vector<double> I = mesh.by_node(bias), V = mesh.by_node(exact.memory.now.output);
    network.I = Eigen::Map<const reference::Vector>(I.data(), size);
    const reference::BlockNetwork blocks(network, static_cast<Eigen::Index>(mesh.components()));
    const reference::Vector found =
        reference::rest_from(blocks, Eigen::Map<const reference::Vector>(V.data(), size)).V;
    std::vector<double> by_node(found.data(), found.data() + size);
    return mesh.by_cell(by_node);
  }

  const levels::BuiltMesh mesh;
  const spec::ArraySpec array;
  Side<levels::NativeHost> exact;
  Side<levels::NativeFixedHost> whole;
};

scene::Scene by_increments(scene::Scene scene) {
  scene.motion.formulation = scene::Formulation::incremental;
  return scene;
}

/// Rms difference over rms, of weights and biases.
void expect_close_networks(const Pair& pair, double weights, double biases) {
  const StepMemory &a = pair.exact.memory, &b = pair.whole.memory;
  EXPECT_LT(rms(a.weight, b.weight), weights * rms(a.weight));
  EXPECT_LT(rms(a.bias, b.bias), biases * rms(a.bias));
}

TEST(FixedHost, MakesTheNetworkOfDoublesProbed) {
  Pair pair(grid_scene(5, 5), spec::guarded_array());
  for (int k = 0; k < 10; ++k) {
    pair.step();
    expect_close_networks(pair, 1e-6, 1e-5);
    EXPECT_EQ(pair.exact.host.driver().shift, pair.whole.host.driver().shift);
    EXPECT_LT(rms(pair.exact.memory.start, pair.whole.memory.start), 1e-8);
  }
}

TEST(FixedHost, MakesTheNetworkOfDoublesImplicit) {
  Pair pair(by_increments(grid_scene(5, 5)), spec::guarded_array());
  for (int k = 0; k < 10; ++k) {
    pair.step();
    expect_close_networks(pair, 1e-6, 1e-4);
    EXPECT_EQ(pair.exact.memory.state.scale, pair.whole.memory.state.scale);
    EXPECT_EQ(pair.exact.host.driver().shift, pair.whole.host.driver().shift);
  }
}

// From the same outputs: what the probe makes of them.
TEST(FixedHost, MovesNodesAsDoublesDo) {
  Pair pair(grid_scene(4, 4), fine_array());
  for (int k = 0; k < 10; ++k) {
    pair.step();
    const StepMemory &a = pair.exact.memory, &b = pair.whole.memory;
    const double off = rms(a.now.output, b.now.output);
    EXPECT_LT(rms(a.direction, b.direction), 10 * off + 1e-6);
    EXPECT_LT(rms(a.energy_change, b.energy_change), (10 * off + 1e-4) * rms(a.energy_change) + 1e-9);
    EXPECT_LT(rms(a.now.position, b.now.position), 1e-6 + off);
  }
}

/// V at rest of the two networks of a step, in the array's codes: median over steps 5 to 44.
double median_off(const std::vector<std::string>& overrides) {
  const levels::Prepared p = levels::prepare("flag-400", "", overrides);
  Pair pair(p.inputs.scene, p.inputs.array);
  std::vector<double> off;
  for (int k = 0; k < 45; ++k) {
    pair.step();
    if (k >= 5) off.push_back(rms(pair.rest(pair.exact), pair.rest(pair.whole)));
  }
  std::printf("flag-400: V at rest off by %.2g rms, median of 40 steps; at most %.2g\n", median(off),
              *std::max_element(off.begin(), off.end()));
  return median(off);
}

TEST(FixedHost, RestsOfFlag400AreWithinATenThousandth) {
  EXPECT_LE(median_off({}), 1e-4);
  EXPECT_LE(median_off({"motion.formulation=incremental"}), 1e-4);
}

/// A scene of whole numbers on a software array.
struct WholeFlight {
  explicit WholeFlight(scene::Scene s, const spec::ArraySpec& a = spec::guarded_array(), bool check = false)
      : scene(in_whole_numbers(std::move(s))), mesh(scene), port(a, mesh.topology()),
        motion(scene, mesh, a, port, check) {}
  static scene::Scene in_whole_numbers(scene::Scene s) {
    s.host.arithmetic = scene::Arithmetic::fixed;
    s.relax.max_sweeps = 30;
    return s;
  }
  scene::Scene scene;
  levels::BuiltMesh mesh;
  SoftArray port;
  levels::ArrayMover motion;
};

TEST(FixedHost, TheCheckTellsItsErrorBesideTheArrays) {
  WholeFlight flight(grid_scene(4, 4), spec::guarded_array(), true);
  for (int k = 0; k < 4; ++k) {
    const levels::StepRow row = flight.motion.advance();
    ASSERT_TRUE(row.host_error);
    EXPECT_GT(row.error->network, 1e-10) << "whole numbers round";
    EXPECT_LT(row.error->network, 1e-5);
    EXPECT_LT(*row.host_error, 1e-2); // so small a sheet has soft modes
  }
}

TEST(FixedHost, GoesOnFromAState) {
  for (const bool increments : {false, true}) {
    const scene::Scene scene = increments ? by_increments(grid_scene(3, 4)) : grid_scene(3, 4);
    WholeFlight whole(scene), part(scene);
    for (int k = 0; k < 4; ++k) whole.motion.advance();
    part.motion.restore(whole.motion.state(), {});
    for (int k = 0; k < 3; ++k) EXPECT_EQ(part.motion.advance().hash, whole.motion.advance().hash);
  }
}

// A mesh that rests stays: the pull is 0, and no scale follows from it.
TEST(FixedHost, WhatNothingPullsStays) {
  scene::Scene scene = by_increments(grid_scene(3, 3));
  scene.force = {};
  WholeFlight flight(scene);
  const auto before = flight.motion.positions();
  for (int k = 0; k < 3; ++k) flight.motion.advance();
  EXPECT_LT(rms(before, flight.motion.positions()), 1e-6);
}

TEST(FixedHost, ANodeThatLeavesTheRangeIsLostAndTheLastGoodStateStays) {
  for (const bool increments : {false, true}) {
    scene::Scene scene = increments ? by_increments(grid_scene(2, 3)) : grid_scene(2, 3);
    scene.mesh.pinned.clear();
    scene.force.gravity = {0, 0, -900};
    scene.motion.friction = 1;
    WholeFlight flight(scene);
    std::vector<double> before;
    const auto until_it_is_lost = [&] {
      for (int k = 0; k < 200; ++k) {
        before = flight.motion.positions();
        flight.motion.advance();
      }
    };
    EXPECT_THROW(until_it_is_lost(), levels::LostMotion);
    EXPECT_EQ(flight.motion.positions(), before);
  }
}

TEST(FixedHost, WhatItDoesNotCoverIsRefusedByKey) {
  using Change = void (*)(scene::Scene&);
  const std::pair<const char*, Change> cases[] = {
      {"mesh.planar",
       [](scene::Scene& s) {
         s.mesh.planar = true, s.force.wind = scene::Vector3{0.3, 0, 0};
       }},
      {"mesh.springs.law", [](scene::Scene& s) { s.mesh.law = scene::SpringLaw::tension, s.mesh.rest = 0; }},
      {"incremental.rule",
       [](scene::Scene& s) { s = by_increments(s), s.incremental.rule = scene::Rule::bdf2; }},
      {"probe.acceleration_memory", [](scene::Scene& s) { s.probe.acceleration_memory = 0.5; }},
      {"probe.energy_springs", [](scene::Scene& s) { s.probe.energy_springs = scene::EnergySprings::all; }},
      {"relax.expansions", [](scene::Scene& s) { s.relax.expansions = 2; }},
      {"relax.refinements", [](scene::Scene& s) { s = by_increments(s), s.relax.refinements = 1; }},
      {"relax.stop", [](scene::Scene& s) { s.relax.stop = scene::Stop::sum; }},
      {"motion.time_step", [](scene::Scene& s) { s.motion.time_step = 100; }}};
  for (const auto& [key, change] : cases) {
    scene::Scene scene = grid_scene(3, 3);
    change(scene);
    EXPECT_THAT(complaint([&] { WholeFlight{scene}; }), HasSubstr(key));
  }
  EXPECT_THAT(complaint([&] {
                WholeFlight{grid_scene(3, 3), spec::prescaled_array()};
              }),
              HasSubstr("array.normaliser"));
}

} // namespace
} // namespace hopmesh::tests
