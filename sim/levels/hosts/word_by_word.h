// A host without a bus master: no transfer is longer than a word.
#pragma once

#include "firmware/host_bus.h"

namespace hopmesh::levels {

class WordByWord : public HostBus {
 public:
  explicit WordByWord(HostBus& inner) : inner_(inner) {}

  int read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) override {
    int error = HM_OK;
    for (std::uint32_t k = 0; k < count && error == HM_OK; ++k)
      error = inner_.read(address + 4 * k, words + k, 1);
    return error;
  }
  int write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) override {
    int error = HM_OK;
    for (std::uint32_t k = 0; k < count && error == HM_OK; ++k)
      error = inner_.write(address + 4 * k, words + k, 1);
    return error;
  }
  int wait_for_irq() override { return inner_.wait_for_irq(); }

 private:
  HostBus& inner_;
};

} // namespace hopmesh::levels
