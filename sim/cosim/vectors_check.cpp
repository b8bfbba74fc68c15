// A filled-in file against an array of ours, line by line.
#include "sim/cosim/vectors.h"

#include <fmt/format.h>

namespace hopmesh::cosim {

namespace {

struct Judge {
  const std::string& path;
  const VectorCase& a_case;
  const Timing& timing;

  std::string place(const AnswerLine& a) const {
    return fmt::format("{}:{}: case {}, sweep {}, phase {}, cycle {}", path, a.line, a_case.name, a.sweep,
                       a.phase, timing.published(a.sweep, a.phase));
  }
  std::string of_fire(const AnswerLine& a, const Codes& before, const Codes& after) const;
  std::string of_end(const AnswerLine& a, const spec::Relaxation& end) const;
};

std::string inputs_text(const Divergence& d) {
  std::string text = fmt::format("\n  V before {}, bias {}; its inputs one update earlier{}:", d.before_raw,
                                 d.bias_raw, ahead_note(d.ahead));
  for (const Tap& tap : d.taps)
    text += fmt::format("\n    cell {:>6} neuron {}  weight {:>11}  V {:>11}", tap.cell, tap.component,
                        tap.weight_raw, tap.output_raw);
  return text;
}

std::string Judge::of_fire(const AnswerLine& a, const Codes& before, const Codes& after) const {
  const std::uint64_t cycle = timing.published(a.sweep, a.phase);
  const auto& neurons = timing.phases[a.phase];
  for (std::size_t k = 0; k < neurons.size(); ++k) {
    const std::uint32_t i = neurons[k];
    if (a.codes[k] == after[i]) continue;
    Codes found = after;
    found[i] = a.codes[k];
    const auto n = static_cast<std::uint32_t>(a_case.job.topology.neurons_per_cell);
    return fmt::format("{}, cell {} neuron {} (neuron {} of the case): found {}, expected {}", place(a),
                       i / n, i % n, i, a.codes[k], after[i]) +
           inputs_text(locate(a_case.job, a.sweep, before, after, found));
  }
  if (a.cycle == cycle) return "";
  return fmt::format("{}: found cycle {}, expected {}", place(a), a.cycle, cycle);
}

std::string Judge::of_end(const AnswerLine& a, const spec::Relaxation& end) const {
  const auto text = [](const spec::Relaxation& e) {
    return fmt::format("end {} {:d} {} {} {}", e.sweeps, e.converged, e.largest_change, e.largest_sum,
                       e.cycles);
  };
  if (a.run == end) return "";
  return fmt::format("{}:{}: case {}: found {}, expected {} (sweeps, converged, largest change, largest sum, "
                     "cycles)",
                     path, a.line, a_case.name, text(a.run), text(end));
}

} // namespace

std::string check_answers(const std::string& path, VectorReader& reader, const VectorCase& a_case,
                          const hm_bus& bus, std::uint64_t& lines) {
  const ArrayJob& job = a_case.job;
  const Timing timing(job);
  const Judge judge{path, a_case, timing};
  const BusArray array(bus, job.topology);
  load(array, job);
  const Codes start = array.outputs(); // held within [-1, 1] as it was written
  const spec::Relaxation end = run_whole(array, job);
  SweepBySweep sweeps(array, job);
  Codes before = start;
  for (std::uint64_t sweep = 1; sweep <= end.sweeps; ++sweep) {
    sweeps.next();
    Codes after = array.outputs();
    for (std::size_t k = 0; k < timing.phases.size(); ++k, ++lines) {
      const AnswerLine a = reader.answer();
      if (a.end)
        return fmt::format("{}:{}: case {}: found the end after {} sweeps, expected sweep {} of {}", path,
                           a.line, a_case.name, sweep - 1, sweep, end.sweeps);
      std::string wrong = judge.of_fire(a, before, after);
      if (!wrong.empty()) return wrong;
    }
    before = std::move(after);
  }
  const AnswerLine a = reader.answer();
  if (!a.end)
    return fmt::format("{}:{}: case {}: found sweep {}, expected the end after {} sweeps", path, a.line,
                       a_case.name, a.sweep, end.sweeps);
  lines += 1;
  return judge.of_end(a, end);
}

} // namespace hopmesh::cosim
