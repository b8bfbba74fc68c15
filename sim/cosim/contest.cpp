#include "sim/cosim/contest.h"

#include "sim/cosim/divergence.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cosim {

Answer ask(const BusArray& array, const ArrayJob& job, bool every_sweep) {
  Answer a;
  a.capabilities = array.capabilities();
  load(array, job);
  a.weight = array.weights(), a.bias = array.biases(), a.start = array.outputs();
  if (!job.momentum.empty()) a.momentum = array.momentum(job.momentum.size());
  a.end = run_whole(array, job);
  a.output = array.outputs();
  a.bus_cycles = array.bus_cycles();
  if (!every_sweep) return a;
  SweepBySweep sweeps(array, job);
  for (std::uint32_t sweep = 0; sweep < a.end.sweeps; ++sweep) {
    a.sweeps.push_back(sweeps.next());
    a.outputs.push_back(array.outputs());
  }
  return a;
}

namespace {

std::string text_of(const spec::Relaxation& e) {
  return fmt::format("{} sweeps, {}, largest change {}, largest sum {}, {} cycles", e.sweeps,
                     e.converged ? "converged" : "not converged", e.largest_change, e.largest_sum, e.cycles);
}

template <typename T>
std::string unequal_words(const char* what, const std::vector<T>& a, const std::vector<T>& b) {
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    if (a[k] != b[k]) return fmt::format("{} {}: {} and {}", what, k, a[k], b[k]);
  return "";
}

std::string unequal_sweeps(const Answer& a, const Answer& b, const ArrayJob& job) {
  for (std::size_t k = 0; k < std::min(a.outputs.size(), b.outputs.size()); ++k) {
    if (a.outputs[k] != b.outputs[k]) {
      const Divergence d =
          locate(job, k + 1, k == 0 ? a.start : a.outputs[k - 1], a.outputs[k], b.outputs[k]);
      return fmt::format("sweep {}, phase {}, cycle {}, neuron {}: {} and {}", d.sweep, d.phase, d.cycle,
                         d.neuron, d.raw[0], d.raw[1]);
    }
    if (!(a.sweeps[k] == b.sweeps[k]))
      return fmt::format("sweep {}: {} and {}", k + 1, text_of(a.sweeps[k]), text_of(b.sweeps[k]));
  }
  return "";
}

} // namespace

std::string unequal(const Answer& a, const Answer& b, const ArrayJob& job) {
  for (const std::string& text :
       {unequal_words("capability register", a.capabilities, b.capabilities),
        unequal_words("weight word", a.weight, b.weight), unequal_words("bias word", a.bias, b.bias),
        unequal_words("start word", a.start, b.start), unequal_words("momentum word", a.momentum, b.momentum),
        unequal_sweeps(a, b, job), unequal_words("output of neuron", a.output, b.output)})
    if (!text.empty()) return text;
  if (!(a.end == b.end)) return text_of(a.end) + " and " + text_of(b.end);
  if (a.bus_cycles != b.bus_cycles) return fmt::format("bus cycles: {} and {}", a.bus_cycles, b.bus_cycles);
  return "";
}

MadeAhead make_ahead(const Ways& ways, const ArrayJob& job,
                     const std::function<bool(std::size_t)>& takes_part) {
  MadeAhead made(ways.size());
  for (std::size_t k = 0; k < ways.size(); ++k)
    if (ways[k].made_ahead && takes_part(k)) made[k] = ways[k].make(job.array, job.topology);
  return made;
}

Mismatch contest(const Ways& ways, const ArrayJob& job, const MadeAhead& ahead, bool every_sweep,
                 const std::function<bool(std::size_t)>& takes_part) {
  std::unique_ptr<levels::ArrayPort> made;
  const auto array_of = [&](std::size_t k) {
    if (!takes_part(k) || ways[k].made_ahead) return ahead[k].get();
    made = ways[k].make(job.array, job.topology);
    return made.get();
  };
  const auto answer = [&](levels::ArrayPort& array) {
    return ask(BusArray(array.bus(), job.topology), job, every_sweep);
  };
  const Answer first = answer(*array_of(0));
  for (std::size_t k = 1; k < ways.size(); ++k)
    if (levels::ArrayPort* array = array_of(k)) {
      const std::string text = unequal(first, answer(*array), job);
      if (!text.empty()) return {k, ways[0].name + " and " + ways[k].name + ": " + text};
    }
  return {};
}

Mismatch contest(const Ways& ways, const ArrayJob& job) {
  const auto all = [](std::size_t) { return true; };
  return contest(ways, job, make_ahead(ways, job, all), true, all);
}

} // namespace hopmesh::cosim
