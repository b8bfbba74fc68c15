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
      output_(topology.neurons()) {}

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
