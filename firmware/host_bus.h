// The firmware's bus for a host that is written in C++: whatever stands behind it is a class with three
// functions.
#pragma once

#include "firmware/bus.h"

namespace hopmesh {

/// A single word is a burst of one. Every function answers as the calls of hm_bus do.
class HostBus {
 public:
  HostBus() : calls_{this, &read_word, &write_word, &read_burst, &write_burst, &wait} {}
  virtual ~HostBus() = default;
  HostBus(const HostBus&) = delete;
  HostBus& operator=(const HostBus&) = delete;

  /// As the firmware takes it.
  const hm_bus& bus() const { return calls_; }

  virtual int read(uint32_t address, uint32_t* words, uint32_t count) = 0;
  virtual int write(uint32_t address, const uint32_t* words, uint32_t count) = 0;
  /// Until the array's interrupt line is up.
  virtual int wait_for_irq() = 0;

 private:
  static HostBus& self(void* context) { return *static_cast<HostBus*>(context); }
  static int read_word(void* context, uint32_t address, uint32_t* word) {
    return self(context).read(address, word, 1);
  }
  static int write_word(void* context, uint32_t address, uint32_t word) {
    return self(context).write(address, &word, 1);
  }
  static int read_burst(void* context, uint32_t address, uint32_t* words, uint32_t count) {
    return self(context).read(address, words, count);
  }
  static int write_burst(void* context, uint32_t address, const uint32_t* words, uint32_t count) {
    return self(context).write(address, words, count);
  }
  static int wait(void* context) { return self(context).wait_for_irq(); }

  const hm_bus calls_;
};

} // namespace hopmesh
