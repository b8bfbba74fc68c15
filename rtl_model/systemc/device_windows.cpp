// The device's windows: where they lie, and how their words become codes of the memories behind them.
#include "rtl_model/systemc/device.h"

namespace hopmesh::systemc {

namespace {

/// The low bits that a memory of this format keeps, sign extended.
std::int32_t cut(std::uint32_t word, const spec::NumberFormat& f) {
  const int unused = 32 - f.width;
  return static_cast<std::int32_t>(word << unused) >> unused;
}

} // namespace

void Device::set_windows() {
  const spec::MemoryMap map = spec::memory_map(cells.array(), cells.topology());
  const auto at = [&](spec::Window w) -> Window& {
    windows_[static_cast<std::size_t>(w)].at = map[w];
    return windows_[static_cast<std::size_t>(w)];
  };
  at(spec::Window::FIRST_LINK).get = &Device::get_first_link;
  at(spec::Window::LINK).get = &Device::get_link;
  at(spec::Window::BIAS).get = &Device::get_bias;
  at(spec::Window::BIAS).put = &Device::put_bias;
  at(spec::Window::OUTPUT).get = &Device::get_output;
  at(spec::Window::OUTPUT).put = &Device::put_output;
  at(spec::Window::WEIGHT).get = &Device::get_weight;
  at(spec::Window::WEIGHT).put = &Device::put_weight;
  at(spec::Window::MOMENTUM).get = &Device::get_momentum;
  at(spec::Window::MOMENTUM).put = &Device::put_momentum;
}

// Codes share a word from its low end on; places behind the last code read as 0.
std::uint32_t Device::get_word(const Window& window, std::uint64_t index) const {
  const auto n = static_cast<std::uint64_t>(window.at.codes_a_word);
  if (n == 1) return (this->*window.get)(index);
  const int bits = window.at.code_bits();
  std::uint32_t word = 0;
  for (std::uint64_t k = n * index; k < std::min(n * (index + 1), window.at.codes); ++k)
    word |= ((this->*window.get)(k) & ((1u << bits) - 1)) << bits * static_cast<int>(k % n);
  return word;
}

void Device::put_word(const Window& window, std::uint64_t index, std::uint32_t word) {
  const auto n = static_cast<std::uint64_t>(window.at.codes_a_word);
  for (std::uint64_t k = n * index; k < std::min(n * (index + 1), window.at.codes); ++k)
    (this->*window.put)(k, word >> window.at.code_bits() * static_cast<int>(k % n));
}

std::uint32_t Device::get_first_link(std::uint64_t k) const {
  return cells.topology().first_link[k];
}
std::uint32_t Device::get_link(std::uint64_t k) const {
  return cells.topology().link_to[k];
}

std::uint32_t Device::get_bias(std::uint64_t k) const {
  return static_cast<std::uint32_t>(cells.bias(k));
}

std::uint32_t Device::get_output(std::uint64_t k) const {
  return static_cast<std::uint32_t>(cells.state_raw(k));
}

std::uint32_t Device::get_weight(std::uint64_t k) const {
  const auto [neuron, tap] = weight_place(k);
  return static_cast<std::uint32_t>(cells.weight(neuron, tap));
}

std::uint32_t Device::get_momentum(std::uint64_t k) const {
  return static_cast<std::uint32_t>(cells.momentum.code(k));
}

void Device::put_bias(std::uint64_t k, std::uint32_t word) {
  cells.set_bias(k, cut(word, cells.array().formats.bias));
}

void Device::put_output(std::uint64_t k, std::uint32_t word) {
  cells.load(k, static_cast<std::int32_t>(word));
}

void Device::put_weight(std::uint64_t k, std::uint32_t word) {
  const auto [neuron, tap] = weight_place(k);
  cells.set_weight(neuron, tap, cut(word, cells.array().formats.weight));
}

void Device::put_momentum(std::uint64_t k, std::uint32_t word) {
  cells.momentum.set_code(k, cut(word, spec::momentum_format));
}

std::pair<std::size_t, std::size_t> Device::weight_place(std::uint64_t k) const {
  const spec::Topology& t = cells.topology();
  const std::size_t per_cell = t.neurons_per_cell;
  std::size_t low = 0, high = t.cells(); // the last cell whose rows begin at or before k
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (t.row_offset(middle, 0) <= k ? low : high) = middle;
  }
  const std::size_t within = k - t.row_offset(low, 0);
  return {low * per_cell + within / t.taps(low), within % t.taps(low)};
}

} // namespace hopmesh::systemc
