#include "sim/cosim/firings/run_firings.h"

#include "rtl_model/spec/schedule.h"
#include "sim/cosim/firings/edge_search.h"
#include "sim/cosim/loaded_job.h"
#include "sim/levels/interrupt.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace hopmesh::cosim {

namespace {

/// Memories of the array as the host loaded them, and V, L and Y of every neuron as the run goes on.
class OpenRun {
 public:
  OpenRun(const ArrayJob& job, const BusArray& array, const NeuronShape& shape,
          const levels::OpenNeuron& neuron)
      : topology_(job.topology), shape_(shape), neuron_(neuron), weights_(array.weights()),
        biases_(array.biases()), states_(array.outputs()), ahead_(states_) {
    if (!job.momentum.empty()) table_ = array.momentum(job.momentum.size());
    for (std::int32_t v : states_) links_.push_back(link_of(neuron, v));
  }

  void sweep(std::uint64_t number, const spec::Phases& phases, const TakeFiring& take) {
    std::int64_t agreement = 0; // of moves with the sums that led to them
    for (const auto& phase : phases) {
      const Codes before = links_; // what everybody in this phase reads
      for (std::uint32_t i : phase) {
        Firing f = fired(shape_, neuron_, inputs(i, before));
        f.sweep = number, f.neuron = i;
        states_[i] = f.steps.state, links_[i] = f.steps.link, ahead_[i] = f.steps.extrapolated;
        const std::int64_t sum = f.steps.sum.back();
        agreement += sum > 0 ? f.steps.change : sum < 0 ? -f.steps.change : 0;
        take(f);
      }
    }
    if (!table_.empty()) check(agreement < 0);
  }

  const Codes& states() const { return states_; }

 private:
  std::size_t per_cell() const { return static_cast<std::size_t>(topology_.neurons_per_cell); }

  void check(bool restart) {
    if (restart) {
      entry_ = 0;
      ahead_ = states_;
      for (std::size_t i = 0; i < states_.size(); ++i) links_[i] = link_of(neuron_, states_[i]);
    }
    entry_ = std::min(entry_ + 1, table_.size() - 1);
  }

  spec::FiringInputs inputs(std::uint32_t neuron, const Codes& links) const {
    const std::size_t cell = neuron / per_cell();
    const auto row =
        weights_.begin() + static_cast<std::ptrdiff_t>(topology_.row_offset(cell, neuron % per_cell()));
    spec::FiringInputs in;
    in.weight.assign(row, row + static_cast<std::ptrdiff_t>(topology_.taps(cell)));
    const auto add = [&](std::size_t source) {
      for (std::size_t q = 0; q < per_cell(); ++q) in.link.push_back(links[source * per_cell() + q]);
    };
    add(cell);
    for (std::size_t k = topology_.first_link[cell]; k < topology_.first_link[cell + 1]; ++k)
      add(topology_.link_to[k]);
    in.bias = biases_[neuron], in.state = states_[neuron];
    in.own_tap = static_cast<std::uint32_t>(neuron % per_cell());
    if (!table_.empty()) in.extrapolated = ahead_[neuron], in.momentum = table_[entry_];
    return in;
  }

  const spec::Topology& topology_;
  const NeuronShape& shape_;
  const levels::OpenNeuron& neuron_;
  const Codes weights_, biases_;
  Codes states_, links_, ahead_;
  Codes table_; ///< of m; empty without momentum
  std::size_t entry_ = 0;
};

} // namespace

bool run_firings(const ArrayJob& job, const NeuronShape& shape, const levels::Level& level,
                 const levels::OpenNeuron& neuron, const TakeFiring& take) {
  const auto port = level.make_port(job.array, job.topology, {});
  const BusArray array(port->bus(), job.topology);
  load(array, job);
  OpenRun open(job, array, shape, neuron);
  const spec::Phases phases = spec::phases_of(job.topology, job.array.schedule);
  const spec::Relaxation end = run_whole(array, job);
  SweepBySweep sweeps(array, job);
  for (std::uint64_t sweep = 1; sweep <= end.sweeps; ++sweep) {
    if (levels::stop_requested) return false;
    open.sweep(sweep, phases, take);
    sweeps.next();
    if (open.states() != array.outputs())
      throw std::logic_error(
          fmt::format("{}: the array and its open neuron part in sweep {}", level.name, sweep));
  }
  return true;
}

} // namespace hopmesh::cosim
