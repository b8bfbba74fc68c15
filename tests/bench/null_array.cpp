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
  bus_.context = this;
  bus_.read = [](void* c, std::uint32_t address, std::uint32_t* word) {
    *word = static_cast<NullArray*>(c)->read_register(address);
    return static_cast<int>(HM_OK);
  };
  bus_.write = [](void*, std::uint32_t, std::uint32_t) { return static_cast<int>(HM_OK); };
  bus_.read_burst = [](void* c, std::uint32_t address, std::uint32_t* words, std::uint32_t count) {
    auto* me = static_cast<NullArray*>(c);
    std::memcpy(words, me->window(address), 4 * std::size_t{count});
    if (me->outputs_left_ > 0 && (me->outputs_left_ -= count) == 0) me->lap(me->seconds.read_back);
    return static_cast<int>(HM_OK);
  };
  bus_.write_burst = [](void* c, std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
    std::memcpy(static_cast<NullArray*>(c)->window(address), words, 4 * std::size_t{count});
    return static_cast<int>(HM_OK);
  };
  bus_.wait = [](void* c) {
    auto* me = static_cast<NullArray*>(c);
    me->lap(me->seconds.load);
    me->loading_ = false;
    me->outputs_left_ = static_cast<std::uint32_t>(me->output_.size());
    return static_cast<int>(HM_OK);
  };
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
