// The memory of a folded array's links. Every element has one, and a V that is written goes to all of them:
// so all hold the same, and one stands for all.
#pragma once

#include <cstdint>
#include <systemc>
#include <vector>

namespace hopmesh::systemc {

/// A raw code a neuron. With two banks, writes go to the one that nobody reads, and the banks change places
/// at the end of a phase.
class LinkMemory : public sc_core::sc_prim_channel {
 public:
  LinkMemory(const char* name, std::size_t neurons, bool two_banks)
      : sc_prim_channel(name), neurons_(neurons), codes_(two_banks ? 2 * neurons : neurons, 0) {}

  /// Where neighbours read a neuron, in the first bank.
  const std::int32_t* wires(std::size_t neuron) const { return &codes_[neuron]; }
  /// Places from there to the bank that is read.
  std::ptrdiff_t bank() const { return second_ ? static_cast<std::ptrdiff_t>(neurons_) : 0; }
  std::int32_t read(std::size_t neuron) const { return wires(neuron)[bank()]; }

  void write(std::size_t neuron, std::int32_t raw) {
    codes_[two_banks() && !second_ ? neurons_ + neuron : neuron] = raw;
  }
  /// From the host, outside a run: shows at once.
  void load(std::size_t neuron, std::int32_t raw) { codes_[static_cast<std::size_t>(bank()) + neuron] = raw; }
  /// Banks change places after the update phase: whoever is woken now still reads the old one.
  void end_phase() {
    if (two_banks()) request_update();
  }

 protected:
  void update() override { second_ = !second_; }

 private:
  bool two_banks() const { return codes_.size() > neurons_; }

  const std::size_t neurons_;
  std::vector<std::int32_t> codes_;
  bool second_ = false;
};

} // namespace hopmesh::systemc
