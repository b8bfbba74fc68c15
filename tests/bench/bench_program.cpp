// The program as people start it: wall time, processor time and peak memory of `hopmesh run` as a child
// process. A program of its own without SystemC, because a child's peak memory counts its parent's until
// exec.
#include "place.h"

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

using Words = std::vector<std::string>;

struct Child {
  bool ok = false;
  double wall_seconds = 0, processor_seconds = 0, peak_mb = 0;
};

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

[[noreturn]] void become(Words words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  execv(pointers[0], pointers.data());
  _exit(127);
}

Child run(const Words& words) {
  const auto began = std::chrono::steady_clock::now();
  const pid_t pid = fork();
  if (pid == 0) become(words);
  int status = 0;
  rusage used{};
  if (pid < 0 || wait4(pid, &status, 0, &used) != pid) return {};
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - began;
  return {WIFEXITED(status) && WEXITSTATUS(status) == 0, wall.count(),
          seconds(used.ru_utime) + seconds(used.ru_stime), static_cast<double>(used.ru_maxrss) / 1024};
}

std::filesystem::path results_folder() {
  return std::filesystem::temp_directory_path() / ("hopmesh-bench-run-" + std::to_string(getpid()));
}

double simulated_cycles() {
  std::ifstream file(results_folder() / "stats.json");
  return nlohmann::json::parse(file).at("array_cycles").get<double>();
}

void run_program(benchmark::State& state, const Words& options) {
  Words words{HOPMESH_PROGRAM, "run", "flag-400", "--out", results_folder().string()};
  words.insert(words.end(), options.begin(), options.end());
  Child child;
  for (auto _ : state) {
    child = run(words);
    state.SetIterationTime(child.wall_seconds);
  }
  if (!child.ok) return state.SkipWithError("hopmesh run failed");
  state.counters["processor_s"] = child.processor_seconds;
  state.counters["peak_mb"] = child.peak_mb;
  state.counters["cycles"] = simulated_cycles();
  std::filesystem::remove_all(results_folder());
}

void add(const std::string& name, const Words& options, int turns) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [options](benchmark::State& state) { run_program(state, options); })
      ->Iterations(1)
      ->Repetitions(turns)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

/// Few steps: every part of the program has been at work by then, and nothing grows with steps but files.
void add_square(int side) {
  const std::string n = std::to_string(side);
  add("memory/" + std::to_string(side * side),
      {"--level", "systemc", "--steps", "2", "--set", "mesh.grid.rows=" + n, "--set",
       "mesh.grid.columns=" + n},
      1);
}

} // namespace

int main(int argc, char** argv) {
  add("run flag-400/checked", {"--level", "systemc"}, 3);
  add("run flag-400/no check", {"--level", "systemc", "--no-check"}, 3);
  add("run flag-400/engine", {}, 9);
  for (int side : {10, 20, 40, 80}) add_square(side);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
