#include "tests/bench/null_array.h"

#include "rtl_model/spec/capabilities.h"
#include "rtl_model/spec/schedule.h"

#include <cstring>

namespace hopmesh::bench {

NullArray::NullArray(const spec::ArraySpec& array, const spec::Topology& topology)
    : topology_(topology), map_(spec::memory_map(array, topology)),
      weight_(map_[spec::Window::WEIGHT].words()), bias_(map_[spec::Window::BIAS].words()),
      output_(map_[spec::Window::OUTPUT].words()), registers_{{HM_REG_ID, HM_ID_VALUE},
                                                              {HM_REG_VERSION, HM_VERSION_VALUE},
                                                              {HM_REG_SWEEPS, 1}} {
  const std::size_t phases = spec::phases_of(topology, array.schedule).size();
  for (const auto& [offset, word] : spec::capability_words(array, topology, phases))
    registers_[offset] = word;
}

int NullArray::read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) {
  if (address < HM_REGISTER_BYTES) {
    *words = read_register(address);
    return HM_OK;
  }
  std::memcpy(words, window(address), 4 * std::size_t{count});
  if (outputs_left_ > 0 && (outputs_left_ -= count) == 0) lap(seconds.read_back);
  return HM_OK;
}

int NullArray::write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
  if (address >= HM_REGISTER_BYTES) std::memcpy(window(address), words, 4 * std::size_t{count});
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
  using spec::Window;
  const auto in = [&](Window w, const std::vector<std::uint32_t>& words) {
    return const_cast<std::uint32_t*>(words.data()) + (address - map_[w].offset) / 4;
  };
  if (map_[Window::WEIGHT].holds(address)) return in(Window::WEIGHT, weight_);
  if (map_[Window::OUTPUT].holds(address)) return in(Window::OUTPUT, output_);
  if (map_[Window::BIAS].holds(address)) return in(Window::BIAS, bias_);
  if (map_[Window::LINK].holds(address)) return in(Window::LINK, topology_.link_to);
  return in(Window::FIRST_LINK, topology_.first_link);
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
