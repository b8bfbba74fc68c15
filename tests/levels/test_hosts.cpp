// Whoever runs the firmware: the same bits, the same words on the bus in the same order, step by step.
#include "firmware/registers.h"
#include "sim/levels/array_mover.h"
#include "sim/levels/hosts/rv32.h"
#include "tests/levels/recording_port.h"
#include "tests/support/complaint.h"
#include "tests/support/small_scenes.h"

#include "rtl_model/spec/presets.h"

#include <algorithm>
#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using levels::StepRow;
using scene::Arithmetic;
using scene::Core;
using scene::Processor;
using ::testing::HasSubstr;

struct Flight {
  Flight(const scene::Scene& s, const spec::ArraySpec& a)
      : mesh(s), port(a, mesh.topology()), motion(s, mesh, a, port, false) {}
  levels::BuiltMesh mesh;
  RecordingPort port;
  levels::ArrayMover motion;
};

scene::Scene on(scene::Scene scene, Processor processor, Core core = Core::rv32im) {
  scene.host.processor = processor, scene.host.core = core;
  return scene;
}

scene::Scene few_sweeps(int rows, int columns) {
  scene::Scene scene = grid_scene(rows, columns);
  scene.relax.max_sweeps = 30;
  return scene;
}

scene::Scene incremental(scene::Rule rule) {
  scene::Scene scene = few_sweeps(3, 3);
  scene.motion.formulation = scene::Formulation::incremental;
  scene.incremental.rule = rule;
  return scene;
}

void expect_same_row(const StepRow& a, const StepRow& b) {
  EXPECT_EQ(a.hash, b.hash);
  EXPECT_EQ(a.sweeps, b.sweeps);
  EXPECT_EQ(a.cycles, b.cycles);
  EXPECT_EQ(a.bus_cycles, b.bus_cycles);
  EXPECT_EQ(a.clipped, b.clipped);
  EXPECT_EQ(a.vanished, b.vanished);
  EXPECT_EQ(a.converged, b.converged);
  EXPECT_EQ(a.input_left, b.input_left); // of weights and biases as the host left them
  EXPECT_EQ(a.refinements, b.refinements);
  EXPECT_EQ(a.residual, b.residual);
}

/// The native host and both cores.
void expect_all_alike(const scene::Scene& scene, const spec::ArraySpec& array = spec::guarded_array(),
                      int steps = 5) {
  Flight native(on(scene, Processor::native), array);
  Flight plain(on(scene, Processor::rv32, Core::rv32im), array);
  Flight with_fpu(on(scene, Processor::rv32, Core::rv32imfd), array);
  for (int k = 0; k < steps; ++k) {
    SCOPED_TRACE(testing::Message() << "step " << k);
    const StepRow row = native.motion.advance();
    EXPECT_FALSE(row.instructions);
    for (Flight* core : {&plain, &with_fpu}) {
      const StepRow other = core->motion.advance();
      expect_same_row(row, other);
      EXPECT_GT(other.instructions.value_or(0), 1000);
      EXPECT_EQ(core->motion.positions(), native.motion.positions());
      EXPECT_EQ(core->motion.outputs_raw(), native.motion.outputs_raw());
      ASSERT_TRUE(core->port.all == native.port.all);
      EXPECT_EQ(core->motion.last_sweeps(), native.motion.last_sweeps());
    }
  }
}

class Hosts : public testing::Test {
 protected:
  void SetUp() override {
    if (!levels::has_rv32_host()) GTEST_SKIP() << "built without compiler or emulator";
  }
};

TEST_F(Hosts, TheProbe) {
  expect_all_alike(few_sweeps(4, 4));
}

TEST_F(Hosts, TheProbeOnAnArrayWhoseRowsArePrescaled) {
  expect_all_alike(few_sweeps(3, 3), spec::prescaled_array());
}

TEST_F(Hosts, WordsWithMoreThanOneCode) {
  spec::ArraySpec array = spec::byte_array();
  array.packing = true;
  expect_all_alike(few_sweeps(3, 3), array);
}

TEST_F(Hosts, ATableOfMomentumOfAScenesOwn) {
  scene::Scene scene = few_sweeps(3, 3);
  scene.relax.momentum = {0, 0.5, 0.75};
  spec::ArraySpec array = spec::descent_momentum_array();
  array.momentum_entries = 8;
  expect_all_alike(scene, array);
}

TEST_F(Hosts, EveryRuleOfTheIncrementalPotential) {
  for (const scene::Rule rule : {scene::Rule::backward_euler, scene::Rule::bdf2, scene::Rule::statics}) {
    SCOPED_TRACE(scene::name_of(rule));
    expect_all_alike(incremental(rule), spec::guarded_array(), 3);
  }
}

TEST_F(Hosts, CorrectionsAndAStopBySum) {
  scene::Scene scene = incremental(scene::Rule::backward_euler);
  scene.relax.refinements = 2;
  scene.relax.stop = scene::Stop::sum;
  expect_all_alike(scene, spec::guarded_array(), 3);
}

TEST_F(Hosts, AllSpringsAMemoryAndAPlanarMesh) {
  scene::Scene scene = few_sweeps(3, 3);
  scene.probe.acceleration_memory = 0.5;
  scene.probe.energy_springs = scene::EnergySprings::all;
  scene.probe.force_on = scene::ForceOn::acceleration;
  expect_all_alike(scene);
  scene = few_sweeps(3, 3);
  scene.mesh.planar = true;
  scene.force.wind = scene::Vector3{0.3, 0, 0};
  expect_all_alike(scene);
}

TEST_F(Hosts, WithoutABusMasterEachWordIsATransfer) {
  scene::Scene scene = few_sweeps(3, 3), words = scene;
  words.host.dma = false;
  expect_all_alike(words);
  Flight bursts(scene, spec::guarded_array()), single(words, spec::guarded_array());
  Flight core(on(words, Processor::rv32), spec::guarded_array());
  Flight master(on(scene, Processor::rv32), spec::guarded_array());
  for (int k = 0; k < 2; ++k) {
    const StepRow burst = bursts.motion.advance(), word = single.motion.advance();
    EXPECT_EQ(burst.hash, word.hash);
    const StepRow copied = core.motion.advance(), moved = master.motion.advance();
    EXPECT_GT(*copied.instructions, *moved.instructions);
  }
  // Who looks at the bus's own counter sees more of it.
  const auto others = [](std::vector<Transfer> all) {
    const auto of_bus = [](const Transfer& t) {
      return t.address == HM_REG_BUS_CYCLES_LO || t.address == HM_REG_BUS_CYCLES_HI;
    };
    all.erase(std::remove_if(all.begin(), all.end(), of_bus), all.end());
    return all;
  };
  EXPECT_TRUE(others(word_by_word(bursts.port.all)) == others(single.port.all));
}

TEST_F(Hosts, AStoppedStepDidNotHappen) {
  Flight core(on(few_sweeps(2, 3), Processor::rv32), spec::guarded_array());
  core.motion.advance();
  const auto before = core.motion.state();
  core.port.stop = true;
  EXPECT_THROW(core.motion.advance(), levels::Stopped);
  EXPECT_EQ(core.motion.state().position, before.position);
  EXPECT_EQ(core.motion.state().output, before.output);
  core.port.stop = false;
  EXPECT_NO_THROW(core.motion.advance());
}

TEST_F(Hosts, ABrokenBusIsToldWhoeverMovesTheWords) {
  for (const bool dma : {true, false}) {
    scene::Scene scene = on(few_sweeps(2, 3), Processor::rv32);
    scene.host.dma = dma;
    Flight core(scene, spec::guarded_array());
    core.port.refuse = true;
    EXPECT_THAT(complaint<std::runtime_error>([&] { core.motion.advance(); }),
                HasSubstr("the bus refused a transfer"));
  }
}

TEST_F(Hosts, GoesOnFromAState) {
  const scene::Scene scene = on(incremental(scene::Rule::bdf2), Processor::rv32);
  Flight whole(scene, spec::guarded_array()), part(scene, spec::guarded_array());
  for (int k = 0; k < 3; ++k) whole.motion.advance();
  part.motion.restore(whole.motion.state(), {});
  EXPECT_EQ(part.motion.advance().hash, whole.motion.advance().hash);
}

TEST_F(Hosts, TellsWhereInstructionsWent) {
  Flight core(on(few_sweeps(3, 3), Processor::rv32), spec::guarded_array());
  double counted = 0;
  for (int k = 0; k < 2; ++k) counted += *core.motion.advance().instructions;
  const levels::HostCounts counts = core.motion.host_counts();
  std::uint64_t own = 0, charged = 0, springs = 0;
  for (const levels::HostFunction& f : counts.functions) {
    own += f.instructions, charged += f.with_library;
    if (f.name == "add_spring" || f.name.rfind("hm_network", 0) == 0 || f.name.rfind("add_all", 0) == 0)
      springs += f.with_library;
  }
  EXPECT_EQ(own, charged) << "a library's instructions are charged once";
  EXPECT_GT(own, counted) << "and those before the first step are in, too";
  EXPECT_LT(own, 2 * counted);
  EXPECT_GT(springs, own / 10);
  EXPECT_GT(counts.memory_bytes, 64u * 1024);
}

TEST_F(Hosts, WeightsThatStayAreRefused) {
  scene::Scene scene = on(incremental(scene::Rule::backward_euler), Processor::rv32);
  scene.relax.reload = scene::Reload::bias;
  EXPECT_THAT(complaint<input::InputError>([&] { Flight(scene, spec::guarded_array()); }),
              HasSubstr("relax.reload"));
}

// What whole numbers make is no matter of the processor either.
TEST_F(Hosts, WholeNumbers) {
  for (const bool implicit : {false, true}) {
    scene::Scene scene = implicit ? incremental(scene::Rule::backward_euler) : few_sweeps(4, 4);
    scene.host.arithmetic = Arithmetic::fixed;
    scene.force.drag = 0.1;
    expect_all_alike(scene, spec::guarded_array(), 8);
    spec::ArraySpec array = spec::byte_array();
    array.packing = true;
    expect_all_alike(scene, array, 4);
  }
}

// Where a library makes doubles, whole numbers ask none of it.
TEST_F(Hosts, WholeNumbersNeedNoFloatingPoint) {
  for (const bool implicit : {false, true}) {
    scene::Scene scene =
        on(implicit ? incremental(scene::Rule::backward_euler) : few_sweeps(3, 3), Processor::rv32);
    scene.host.arithmetic = Arithmetic::fixed;
    Flight core(scene, spec::guarded_array());
    for (int k = 0; k < 3; ++k) core.motion.advance();
    std::uint64_t firmware = 0;
    for (const levels::HostFunction& f : core.motion.host_counts().functions) {
      firmware += f.name.rfind("hm_fixed", 0) == 0;
      EXPECT_EQ(f.name.find("df"), std::string::npos) << f.name;
      EXPECT_EQ(f.name.find("sf"), std::string::npos) << f.name;
      EXPECT_NE(f.name, "sqrt");
    }
    EXPECT_GT(firmware, 1u);
  }
}

} // namespace
} // namespace hopmesh::tests
