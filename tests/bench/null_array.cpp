#include "tests/bench/null_array.h"

#include "firmware/registers.h"

#include <cstring>

namespace hopmesh::bench {

namespace {

std::uint32_t packed(const spec::NumberFormat& f) {
  return static_cast<std::uint32_t>(f.width) | static_cast<std::uint32_t>(f.integer_bits & 255) << 8 |
         static_cast<std::uint32_t>(f.rounding) << 16 | static_cast<std::uint32_t>(f.overflow) << 24;
}

} // namespace

NullArray::NullArray(const spec::ArraySpec& array, const spec::Topology& topology)
    : array_(array), topology_(topology), weight_(topology.weight_words()), bias_(topology.neurons()),
      output_(topology.neurons()) {
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

std::uint32_t NullArray::read_register(std::uint32_t offset) {
  switch (offset) {
  case HM_REG_ID:
    return HM_ID_VALUE;
  case HM_REG_VERSION:
    return HM_VERSION_VALUE;
  case HM_REG_CAP_CELLS:
    return static_cast<std::uint32_t>(topology_.cells());
  case HM_REG_CAP_NEURONS_PER_CELL:
    return static_cast<std::uint32_t>(topology_.neurons_per_cell);
  case HM_REG_CAP_LINK_WORDS:
    return static_cast<std::uint32_t>(topology_.link_to.size());
  case HM_REG_CAP_NORMALISER:
    return static_cast<std::uint32_t>(array_.normaliser);
  case HM_REG_CAP_OUTPUT:
    return static_cast<std::uint32_t>(array_.output);
  case HM_REG_CAP_FORMAT_WEIGHT:
    return packed(array_.formats.weight);
  case HM_REG_CAP_FORMAT_BIAS:
    return packed(array_.formats.bias);
  case HM_REG_CAP_FORMAT_STATE:
    return packed(array_.formats.state);
  case HM_REG_STATUS: // the driver asks before it loads, and when the run is over
    if (!loading_ && outputs_left_ == 0) lap(seconds.network), loading_ = true;
    return HM_STATUS_DONE | HM_STATUS_CONVERGED;
  case HM_REG_SWEEPS:
    return 1;
  default:
    return 0;
  }
}

void NullArray::lap(double& part) {
  const auto now = Clock::now();
  part += std::chrono::duration<double>(now - mark_).count();
  mark_ = now;
}

} // namespace hopmesh::bench
