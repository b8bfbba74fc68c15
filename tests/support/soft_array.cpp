#include "tests/support/soft_array.h"

#include "rtl_model/spec/capabilities.h"
#include "rtl_model/spec/cycles.h"

#include <algorithm>
#include <cstdlib>

namespace hopmesh::tests {

SoftArray::SoftArray(const spec::ArraySpec& array, const spec::Topology& topology, std::optional<Fault> fault)
    : job_{array, topology, {}, {}, {}}, fault_(fault), first_link_(topology.first_link),
      link_(topology.link_to) {
  job_.array.packing = false;
  map_ = spec::memory_map(job_.array, topology);
  job_.weight.resize(topology.weight_words());
  job_.bias.resize(topology.neurons());
  job_.start.resize(topology.neurons());
  job_.momentum.resize(cosim::table_entries(job_.array));
  registers_ = {{HM_REG_ID, HM_ID_VALUE}, {HM_REG_VERSION, HM_VERSION_VALUE}};
  const std::size_t phases = spec::phases_of(topology, array.schedule).size();
  for (const auto& [offset, word] : spec::capability_words(job_.array, topology, phases))
    registers_[offset] = word;
}

std::uint32_t* SoftArray::word_at(std::uint32_t address) {
  using spec::Window;
  const auto in = [&](Window window, auto& words) {
    return reinterpret_cast<std::uint32_t*>(words.data()) + (address - map_[window].offset) / 4;
  };
  if (map_[Window::WEIGHT].holds(address)) return in(Window::WEIGHT, job_.weight);
  if (map_[Window::OUTPUT].holds(address)) return in(Window::OUTPUT, job_.start);
  if (map_[Window::BIAS].holds(address)) return in(Window::BIAS, job_.bias);
  if (map_[Window::MOMENTUM].holds(address)) return in(Window::MOMENTUM, job_.momentum);
  if (map_[Window::LINK].holds(address)) return in(Window::LINK, link_);
  if (map_[Window::FIRST_LINK].holds(address)) return in(Window::FIRST_LINK, first_link_);
  return &registers_[address];
}

int SoftArray::transfer(std::uint32_t address, std::uint32_t* words, std::uint32_t count, bool write) {
  if (refuse) return HM_ERROR_BUS;
  for (std::uint32_t k = 0; k < count; ++k)
    if (write)
      *word_at(address + 4 * k) = words[k];
    else
      words[k] = *word_at(address + 4 * k);
  registers_[HM_REG_BUS_CYCLES_LO] += static_cast<std::uint32_t>(spec::bus_cycles(job_.array, count));
  if (write && address == map_[spec::Window::OUTPUT].offset) loads_ += 1, sweeps_ = 0;
  if (write && address == HM_REG_CONTROL && (words[0] & HM_CONTROL_START)) run();
  return HM_OK;
}

/// As START finds it.
void SoftArray::take_over(std::uint32_t most) {
  const std::uint32_t by = registers_[HM_REG_STOP];
  job_.threshold = registers_[HM_REG_THRESHOLD];
  job_.max_sweeps = most;
  job_.rule = {HM_FIELD(by, STOP_BY_SUM) != 0, static_cast<int>(HM_FIELD(by, STOP_SHARE)),
               std::uint64_t{registers_[HM_REG_SUM_THRESHOLD_HI]} << 32 |
                   registers_[HM_REG_SUM_THRESHOLD_LO]};
}

/// Momentum and a stop by a share look back to the run's first sweep: such a run is done in one.
ArrayResult SoftArray::run_whole(std::uint32_t most) {
  take_over(most);
  ArrayResult result = run_slow_array(job_);
  job_.start = result.output();
  return result;
}

void SoftArray::tell_end(const ArrayResult& end, std::uint32_t sweeps, std::uint64_t more_cycles) {
  registers_[HM_REG_SWEEPS] = sweeps;
  registers_[HM_REG_LARGEST_CHANGE] = end.largest_change;
  registers_[HM_REG_STATUS] = HM_STATUS_DONE | (end.converged ? HM_STATUS_CONVERGED : 0);
  registers_[HM_REG_CYCLES_LO] = static_cast<std::uint32_t>(slow_cycles(job_, sweeps) + more_cycles);
}

/// Sweep by sweep, so that a fault can come in between.
void SoftArray::run() {
  const bool faulty = fault_ && loads_ > fault_->from_load;
  const std::uint32_t most = std::max(1u, registers_[HM_REG_MAX_SWEEPS]);
  ArrayResult sweep;
  std::uint32_t sweeps = 0;
  if (!fault_) {
    sweep = run_whole(most);
    return tell_end(sweep, sweep.sweeps, 0);
  }
  take_over(1);
  do {
    sweep = run_slow_array(job_);
    job_.start = sweep.output();
    sweeps += 1;
    sweeps_ += 1;
    if (faulty && (fault_->of_run ? sweeps : sweeps_) == fault_->sweep)
      job_.start[fault_->neuron] ^= fault_->bit;
  } while (!sweep.converged && sweeps < most);
  tell_end(sweep, sweeps, faulty ? fault_->more_cycles : 0);
}

std::vector<levels::SignalRange> SoftArray::inner_ranges() const {
  return {{"drive", job_.array.formats.drive, -3, 4}};
}

} // namespace hopmesh::tests
