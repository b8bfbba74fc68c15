// Largest |V' - V| of a sweep: a maximum over all neurons, read by the sequencer after the last phase.
#pragma once

#include <cstdint>
#include <systemc>

namespace hopmesh::systemc {

class ConvergenceDetector : public sc_core::sc_module {
 public:
  explicit ConvergenceDetector(sc_core::sc_module_name name) : sc_module(name) {}

  void begin_sweep() { largest_ = 0; }
  void report(std::int64_t change) {
    if (change > largest_) largest_ = change;
  }
  std::int64_t largest_change() const { return largest_; }

 private:
  std::int64_t largest_ = 0;
};

} // namespace hopmesh::systemc
