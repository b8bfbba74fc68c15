#include "tests/bench/null_array.h"

#include "rtl_model/spec/capabilities.h"
#include "rtl_model/spec/schedule.h"

#include <cstring>

namespace hopmesh::bench {

NullArray::NullArray(const spec::ArraySpec& array, const spec::Topology& topology)
    : topology_(topology), weight_(topology.weight_words()), bias_(topology.neurons()),
      output_(topology.neurons()), registers_{{HM_REG_ID, HM_ID_VALUE},
                                              {HM_REG_VERSION, HM_VERSION_VALUE},
                                              {HM_REG_SWEEPS, 1}} {
  const std::size_t phases = spec::phases_of(topology, array.schedule).size();
  for (const auto& [offset, word] : spec::capability_words(array, topology, phases))
    registers_[offset] = word;
}

int NullArray::read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) {
  if (address < HM_WINDOW_FIRST_LINK) {
    *words = read_register(address);
    return HM_OK;
  }
  std::memcpy(words, window(address), 4 * std::size_t{count});
  if (outputs_left_ > 0 && (outputs_left_ -= count) == 0) lap(seconds.read_back);
  return HM_OK;
}

int NullArray::write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
  if (address >= HM_WINDOW_FIRST_LINK) std::memcpy(window(address), words, 4 * std::size_t{count});
  return HM_OK;
}

int NullArray::wait_for_irq() {
  lap(seconds.load);
  loading_ = false;
  outputs_left_ = static_cast<std::uint32_t>(output_.size());
  return HM_OK;
}

// The links are the topology's own; whoever only reads is not told otherwise by the type.
std::uint32_t* NullArray::window(std::uint32_t address) {
  const auto in = [address](std::uint32_t base, const std::vector<std::uint32_t>& words) {
    return const_cast<std::uint32_t*>(words.data()) + (address - base) / 4;
  };
  if (address >= HM_WINDOW_WEIGHT) return in(HM_WINDOW_WEIGHT, weight_);
  if (address >= HM_WINDOW_OUTPUT) return in(HM_WINDOW_OUTPUT, output_);
  if (address >= HM_WINDOW_BIAS) return in(HM_WINDOW_BIAS, bias_);
  if (address >= HM_WINDOW_LINK) return in(HM_WINDOW_LINK, topology_.link_to);
  return in(HM_WINDOW_FIRST_LINK, topology_.first_link);
}

// The driver asks for STATUS before it loads, and when the run is over.
std::uint32_t NullArray::read_register(std::uint32_t offset) {
  if (offset != HM_REG_STATUS) return registers_[offset];
  if (!loading_ && outputs_left_ == 0) lap(seconds.network), loading_ = true;
  return HM_STATUS_DONE | HM_STATUS_CONVERGED;
}

void NullArray::lap(double& part) {
  const auto now = Clock::now();
  part += std::chrono::duration<double>(now - mark_).count();
  mark_ = now;
}

} // namespace hopmesh::bench
