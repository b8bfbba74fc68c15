// How fast the engine relaxes flags of any size, and how near that is to what this processor can do at most:
// streams and multiply-adds of the same kind, measured in the same run.
#include "sim/levels/reference_check.h"
#include "sim/reference/reference.h"
#include "tests/bench/clocked_flag.h"
#include "tests/bench/grid_network.h"
#include "tests/bench/roofs.h"

#include <benchmark/benchmark.h>

#include <map>

namespace hopmesh::bench {
namespace {

using benchmark::Counter;
using engine::Engine;
using engine::Options;

const GridNetwork& flag(std::size_t rows, const std::string& array,
                        const std::vector<std::string>& more = {}) {
  static std::map<std::pair<std::size_t, std::string>, GridNetwork> known;
  std::string name = array;
  for (const std::string& key : more) name += " " + key;
  auto [at, is_new] = known.try_emplace({rows, name});
  std::vector<std::string> overrides = more;
  overrides.push_back("relax.max_sweeps=20");
  if (is_new) at->second = grid_network(rows, rows, rows <= 100 ? 20 : 2, array, overrides);
  return at->second;
}

std::vector<std::string> output_keys(const std::string& output) {
  const std::string schedule = output == "momentum" ? "synchronous" : "coloured";
  return {"array.output=" + output, "array.schedule=" + schedule};
}

void relax(benchmark::State& state, const GridNetwork& network, const Options& options) {
  Engine e(network.array, network.topology, options);
  network.load(e);
  const auto count =
      static_cast<std::uint32_t>(std::max<std::size_t>(16, 4000000 / network.neurons() / 16 * 16));
  e.run(0, 1);
  std::uint64_t done = 0;
  for (auto _ : state) {
    const std::uint32_t sweeps = e.run(0, count).sweeps;
    done += sweeps;
    if (sweeps == count) continue;
    state.PauseTiming(); // at rest: from the start again, as short runs would measure how they begin
    network.load(e);
    state.ResumeTiming();
  }
  const double updates = static_cast<double>(done) * static_cast<double>(network.neurons());
  state.counters["updates/s"] = Counter(updates, Counter::kIsRate);
  state.counters["bytes/update"] =
      static_cast<double>(e.bytes_per_sweep()) / static_cast<double>(network.neurons());
  state.SetLabel(e.kernel());
}

/// Momentum on a flag; `apart`: with a weight that differs from its mirror image, so that none is kept once.
const GridNetwork& momentum_flag(std::size_t rows, bool apart = false) {
  static std::map<std::size_t, GridNetwork> known;
  const GridNetwork& network = flag(rows, "", output_keys("momentum"));
  if (!apart) return network;
  const auto [at, is_new] = known.try_emplace(rows, network);
  if (is_new) at->second.weights[1] ^= 1; // from y to x of the first cell
  return at->second;
}

/// That network in doubles, relaxed by the reference in the same order.
void relax_reference(benchmark::State& state) {
  const scene::Inputs inputs = scene::read_inputs("flag-400", "", {});
  const levels::BuiltMesh mesh(inputs.scene);
  const auto motion = reference::step_parameters(inputs.scene);
  const auto order = levels::order_for(mesh, inputs.array.schedule);
  auto at = reference::initial_state(mesh.mesh());
  for (int k = 0; k < 20; ++k) reference::advance(mesh.mesh(), motion, order, at);
  const auto C = reference::predict(mesh.mesh(), motion, at);
  const auto V0 = reference::expansion_point(mesh.mesh(), at);
  const auto network = reference::network(mesh.mesh(), motion, C, V0);
  std::uint64_t done = 0;
  for (auto _ : state) done += reference::relax(network, order, V0, 0, 280).sweeps;
  state.counters["updates/s"] =
      Counter(static_cast<double>(done * mesh.topology().neurons()), Counter::kIsRate);
}

void read_roof(benchmark::State& state, std::size_t bytes) {
  Stream stream(bytes);
  for (auto _ : state) benchmark::DoNotOptimize(stream.read());
  state.counters["bytes/s"] = Counter(
      static_cast<double>(state.iterations()) * static_cast<double>(stream.bytes()), Counter::kIsRate);
}

void multiply_roof(benchmark::State& state) {
  double products = 0;
  for (auto _ : state) products += multiply_add_peak();
  state.counters["products/s"] = Counter(products, Counter::kIsRate);
}

/// Clocks of flag-400 on the clock-stepped engine; `how` steps so many.
void clocks(benchmark::State& state, std::int64_t (ClockedFlag::*how)(std::uint64_t)) {
  constexpr std::uint64_t count = 105219; // a run of 282 sweeps, all but one clock
  static ClockedFlag flag;
  (flag.*how)(count);
  for (auto _ : state) benchmark::DoNotOptimize((flag.*how)(count));
  const auto all = static_cast<double>(state.iterations()) * static_cast<double>(count);
  state.counters["cycles/s"] = benchmark::Counter(all, benchmark::Counter::kIsRate);
  state.counters["s/cycle"] =
      benchmark::Counter(all, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

template <typename Body> void add(const std::string& name, Body body, bool wall = false) {
  auto* b = benchmark::RegisterBenchmark(name.c_str(), body)->Repetitions(5)->Unit(benchmark::kMillisecond);
  b->MinTime(0.1);
  if (wall) b->UseRealTime();
}

// The roofs are of the widest instructions; a processor without them is measured without a roof.
void register_roofs() {
  if (!__builtin_cpu_supports("avx512vnni") || !__builtin_cpu_supports("avx512bw")) return;
  for (std::size_t kib : {32, 96, 384, 1664, 2560, 8192, 262144})
    add("roof read KiB/" + std::to_string(kib), [=](benchmark::State& s) { read_roof(s, kib << 10); });
  add("roof multiply-add/int16", multiply_roof);
}

void register_stages() {
  for (std::size_t rows : {20, 40, 100, 1000}) {
    const std::string nodes = "/" + std::to_string(rows * rows);
    add("projected" + nodes, [=](benchmark::State& s) {
      relax(s, flag(rows, "", output_keys("projected")), {1, "auto", 1});
    });
    for (bool apart : {false, true})
      add((apart ? "momentum, not kept once" : "momentum") + nodes, [=](benchmark::State& s) {
        relax(s, momentum_flag(rows, apart), {1, "auto", 1});
      });
  }
  for (std::size_t threads : {1, 2})
    add(
        "threads, momentum 10000/" + std::to_string(threads),
        [=](benchmark::State& s) {
          relax(s, momentum_flag(100), {threads, "auto", 1});
        },
        true);
  for (std::size_t sweeps : {4, 8, 16})
    add("followed, momentum 1000000/" + std::to_string(sweeps), [=](benchmark::State& s) {
      relax(s, momentum_flag(1000), {1, "auto", sweeps});
    });
}

void register_all() {
  register_roofs();
  for (std::size_t rows : {15, 20, 40, 100, 316, 1000})
    add("plain/" + std::to_string(rows * rows), [=](benchmark::State& s) {
      relax(s, flag(rows, ""), {1, "auto", 1});
    });
  for (const char* kernel : {"generic", "portable", "avx2"})
    add(std::string("kernel/") + kernel, [=](benchmark::State& s) {
      relax(s, flag(20, ""), {1, kernel, 1});
    });
  register_stages();
  for (const char* array : {"descent", "prescaled", "byte", "folded"})
    add(std::string("array/") + array, [=](benchmark::State& s) {
      relax(s, flag(20, array), {1, "auto", 1});
    });
  add("array/32 bits", [](benchmark::State& s) {
    relax(s,
          flag(20, "",
               {"formats.weight=fixed<24,1,SC_RND,SC_SAT>", "formats.bias=fixed<32,9,SC_RND,SC_SAT>",
                "formats.drive=fixed<30,2,SC_RND,SC_SAT>", "formats.state=fixed<32,2,SC_RND,SC_SAT>",
                "formats.link=fixed<26,2,SC_RND,SC_SAT>", "array.reciprocal_bits=32"}),
          {1, "auto", 1});
  });
  add("array/rounding accumulator", [](benchmark::State& s) {
    relax(s, flag(20, "", {"formats.accumulator=fixed<32,12,SC_RND_CONV,SC_WRAP>"}), {1, "auto", 1});
  });
  add("array/sequential", [](benchmark::State& s) {
    relax(s, flag(20, "", {"array.schedule=sequential"}), {1, "auto", 1});
  });
  for (std::size_t threads : {1, 2})
    for (std::size_t rows : {20, 100})
      add(
          "threads " + std::to_string(rows * rows) + "/" + std::to_string(threads),
          [=](benchmark::State& s) {
            relax(s, flag(rows, ""), {threads, "auto", 1});
          },
          true);
  for (std::size_t sweeps : {2, 4, 8, 16})
    add("followed 1000000/" + std::to_string(sweeps), [=](benchmark::State& s) {
      relax(s, flag(1000, ""), {1, "auto", sweeps});
    });
  add("reference/double, Eigen", relax_reference);
  add("clocked/one by one", [](benchmark::State& s) { clocks(s, &ClockedFlag::step); });
  add("clocked/all registers copied", [](benchmark::State& s) { clocks(s, &ClockedFlag::step_and_copy); });
  add("clocked/wave of all registers", [](benchmark::State& s) { clocks(s, &ClockedFlag::step_and_draw); });
  add("clocked/in strides", [](benchmark::State& s) { clocks(s, &ClockedFlag::stride); });
}

} // namespace
} // namespace hopmesh::bench

int main(int argc, char** argv) {
  hopmesh::bench::register_all();
  std::vector<char*> words(argv, argv + argc);
  std::string turns = "--benchmark_enable_random_interleaving=true";
  words.insert(words.begin() + 1, turns.data());
  int count = static_cast<int>(words.size());
  benchmark::Initialize(&count, words.data());
  if (benchmark::ReportUnrecognizedArguments(count, words.data())) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
