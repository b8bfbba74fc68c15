// Time of an array by hand, products by clock, and the cycles of the bus as the driver's were counted.
#include "sim/machine/timeline.h"

#include "rtl_model/spec/cycles.h"
#include "rtl_model/spec/presets.h"
#include "sim/cosim/random_job.h"
#include "sim/engine/clocked/clock_stepped.h"
#include "sim/levels/array_mover.h"
#include "sim/levels/ports/engine_port.h"
#include "sim/machine/silicon.h"
#include "tests/support/small_scenes.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using machine::Timeline;

// Twelve neurons of 12 taps, one a phase: 12 (12 + 2 + 2) + 1 cycles a sweep, 12 + 18 + 1 of prepare.
TEST(Timeline, OfASquareByHand) {
  const spec::Topology square = cosim::grid_topology(2, 2, true);
  const spec::ArraySpec array = spec::guarded_array();
  const machine::RunTransfers bus = machine::run_transfers(array, square, 4096);
  EXPECT_EQ(bus.load, 5u * 2 + (1 + 144) + 2 * (1 + 12));
  EXPECT_EQ(bus.read, 5u * 2 + (1 + 12));
  const machine::Work work = machine::work_of(array, square, 2, 10, 4096);
  EXPECT_EQ(work.array_cycles, 2u * 32 + 10 * 193);
  EXPECT_EQ(work.bus_cycles, 2u * (181 + 23));
  const Timeline t = machine::timeline_of(array, square, work);
  EXPECT_EQ(t.bus, 408u);
  EXPECT_EQ(t.prepare, 64u);
  EXPECT_EQ(t.sweeps, 1930u);
  EXPECT_EQ(t.products, 10u * 144);
  EXPECT_DOUBLE_EQ(t.utilisation(), 1440.0 / (12 * 1994));
  EXPECT_DOUBLE_EQ(t.utilisation_with_bus(), 1440.0 / (12 * 2402));
  EXPECT_DOUBLE_EQ(t.time().seconds(100), 2402e-8);
}

// A burst of at most 100 words: 100 and 44 weights.
TEST(Timeline, LongTransfersGoInBursts) {
  const spec::Topology square = cosim::grid_topology(2, 2, true);
  spec::ArraySpec array = spec::guarded_array();
  EXPECT_EQ(machine::run_transfers(array, square, 100).load, 182u);
  EXPECT_EQ(machine::run_transfers(array, square, 72).load, 182u);
  array.packing = true, array.bus_bits = 64; // 72 words of weights in 36 beats
  EXPECT_EQ(machine::run_transfers(array, square, 4096).load, 5u * 2 + 37 + 2 * (1 + 6));
}

TEST(Timeline, WithoutAnythingCountedNothingIsUsed) {
  const Timeline t = machine::timeline_of(spec::guarded_array(), cosim::grid_topology(2, 2, true), {});
  EXPECT_EQ(t.utilisation(), 0);
  EXPECT_EQ(t.utilisation_with_bus(), 0);
}

// ---- products, clock by clock ----

/// All weights are a last place, all biases 0 and all outputs 1: sums grow by a link of 1 for each product,
/// and no output ever moves.
cosim::ArrayJob counting_job(const spec::ArraySpec& array, const spec::Topology& topology) {
  cosim::ArrayJob job{array, topology, {}, {}, {}, 0, 1};
  job.weight.assign(topology.weight_words(), 1);
  job.bias.assign(topology.neurons(), 0);
  job.start.assign(topology.neurons(), static_cast<std::int32_t>(array.formats.state.one_raw()));
  return job;
}

const std::uint32_t* words(const std::vector<std::int32_t>& codes) {
  return reinterpret_cast<const std::uint32_t*>(codes.data());
}

/// Products of a run, seen from outside: what each clock added to the sums. A sum that became smaller began
/// anew, as rows are longer than an array has lanes.
std::uint64_t products_by_clock(engine::ClockStepped& e, std::int64_t product) {
  std::vector<std::int64_t> before;
  std::vector<engine::Probe> sums;
  std::vector<std::size_t> cells(e.topology().cells());
  for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = c;
  for (const engine::Probe& probe : e.probes(cells))
    if (probe.signal.name == std::string("s")) sums.push_back(probe), before.push_back(probe.code());
  std::uint64_t products = 0;
  e.start(0, 1);
  while (e.busy()) {
    e.step();
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const std::int64_t now = sums[k].code(), begun = now < before[k] ? 0 : before[k];
      EXPECT_EQ((now - begun) % product, 0);
      products += static_cast<std::uint64_t>((now - begun) / product);
      before[k] = now;
    }
  }
  return products;
}

void expect_products(const spec::ArraySpec& array, const spec::Topology& topology) {
  const cosim::ArrayJob job = counting_job(array, topology);
  const auto e = engine::make_clock_stepped(array, topology);
  e->write_weights(0, words(job.weight), job.weight.size());
  e->write_biases(0, words(job.bias), job.bias.size());
  e->write_outputs(0, words(job.start), job.start.size());
  for (int run = 0; run < 2; ++run) {
    const std::uint64_t counted = products_by_clock(*e, array.formats.link.one_raw());
    const spec::Relaxation& r = e->result();
    const Timeline t = machine::timeline_of(array, topology, {r.cycles, 0, r.sweeps});
    EXPECT_EQ(t.products, counted);
    EXPECT_GT(counted, 0u);
    EXPECT_LE(t.products, t.multipliers * r.cycles);
    EXPECT_EQ(t.time().array_cycles, e->cycles().run(r.sweeps));
    EXPECT_EQ(t.prepare, 1 + e->cycles().prepare);
  }
}

TEST(Timeline, ProductsAreThoseCountedByClock) {
  for (const spec::Topology& topology :
       {cosim::grid_topology(2, 2, true), cosim::grid_topology(3, 4, true, 2),
        cosim::grid_topology(5, 4, false)})
    for (const spec::Schedule schedule :
         {spec::Schedule::coloured, spec::Schedule::sequential, spec::Schedule::synchronous})
      for (const int lanes : {1, 2, 5})
        for (const int elements : {0, 1, 3, 8})
          for (const spec::Stages stages : {spec::Stages::each, spec::Stages::one}) {
            spec::ArraySpec array = spec::guarded_array();
            array.schedule = schedule, array.lanes = lanes, array.elements = elements, array.stages = stages;
            SCOPED_TRACE(std::to_string(topology.neurons()) + " neurons, " + std::to_string(lanes) +
                         " lanes, " + std::to_string(elements) + " elements");
            expect_products(array, topology);
          }
}

// ---- the driver's own cycles ----

/// Rows of a motion of some steps.
std::vector<levels::StepRow> rows_of(const scene::Scene& scene, const spec::ArraySpec& array, int steps) {
  const levels::BuiltMesh mesh(scene);
  const std::atomic<bool> stop{false};
  levels::EnginePort port(array, mesh.topology(), {}, {}, stop);
  levels::ArrayMover motion(scene, mesh, array, port, false);
  std::vector<levels::StepRow> rows;
  for (int k = 0; k < steps; ++k) rows.push_back(motion.advance());
  return rows;
}

// A look at the counter of the bus comes before each step: two words, which are counted as any other.
void expect_steps_by_formula(const scene::Scene& scene, const spec::ArraySpec& array) {
  const levels::BuiltMesh mesh(scene);
  const auto runs = static_cast<std::uint64_t>(scene.relax.expansions);
  const std::vector<levels::StepRow> rows = rows_of(scene, array, 3);
  for (const levels::StepRow& row : rows) {
    const machine::Work work =
        machine::work_of(array, mesh.topology(), runs, row.sweeps, levels::longest_burst);
    EXPECT_EQ(row.cycles, work.array_cycles);
    EXPECT_EQ(row.bus_cycles, work.bus_cycles + 2 * spec::bus_cycles(array, 1));
  }
}

TEST(Timeline, AStepTakesWhatTheFormulaSays) {
  scene::Scene scene = grid_scene(10, 10); // 6,300 weights: two bursts
  expect_steps_by_formula(scene, spec::guarded_array());
  expect_steps_by_formula(scene, spec::folded_array());
  spec::ArraySpec array = spec::prescaled_array();
  array.bus_bits = 128, array.packing = true, array.elements = 5;
  expect_steps_by_formula(scene, array);
  scene.relax.expansions = 3;
  array = spec::byte_array();
  array.packing = true;
  expect_steps_by_formula(scene, array);
}

} // namespace
} // namespace hopmesh::tests
