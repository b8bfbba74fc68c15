// A plain software array that answers the register protocol: a level of its own for tests of the study, with
// a fault to order.
#pragma once

#include "rtl_model/spec/memory_map.h"
#include "sim/levels/array_port.h"
#include "tests/support/slow_array.h"

#include <map>
#include <optional>

namespace hopmesh::tests {

/// An output bit flips at the end of a sweep, in every relaxation from `from_load` on. Sweeps are counted
/// since outputs were last written, over all runs: like any real array, this one has no state in a sweep but
/// V.
struct Fault {
  std::uint32_t sweep; ///< 1-based
  std::uint32_t neuron;
  std::int32_t bit = 1;          ///< what is flipped, as a mask
  std::uint32_t from_load = 0;   ///< 0-based, counted in writes of outputs
  std::uint64_t more_cycles = 0; ///< that each run of such a relaxation takes beyond the formula
  bool of_run = false;           ///< sweeps are counted since START instead: a fault of a long run only
};

class SoftArray : public levels::ArrayPort {
 public:
  SoftArray(const spec::ArraySpec& array, const spec::Topology& topology, std::optional<Fault> fault = {});

  int read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) override {
    return transfer(address, words, count, false);
  }
  int write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) override {
    return transfer(address, const_cast<std::uint32_t*>(words), count, true);
  }
  int wait_for_irq() override { return stop ? HM_ERROR_STOPPED : HM_OK; }
  void begin_step(std::uint64_t step) override { begun.push_back(step); }
  void end_step(std::uint64_t step) override { ended.push_back(step); }
  std::vector<levels::SignalRange> inner_ranges() const override;

  /// What a register tells from now on.
  void tell(std::uint32_t offset, std::uint32_t word) { registers_[offset] = word; }
  /// Counts `from_load` from now.
  void forget_loads() { loads_ = 0; }

  bool refuse = false; ///< every transfer fails from now on
  bool stop = false;   ///< waiting is given up
  std::vector<std::uint64_t> begun, ended;

 private:
  std::uint32_t* word_at(std::uint32_t address);
  int transfer(std::uint32_t address, std::uint32_t* words, std::uint32_t count, bool write);
  void take_over(std::uint32_t most);
  ArrayResult run_whole(std::uint32_t most);
  void tell_end(const ArrayResult& end, std::uint32_t sweeps, std::uint64_t more_cycles);
  void run();

  ArrayJob job_; ///< a code a word, whatever the array's packing is
  spec::MemoryMap map_;
  std::optional<Fault> fault_;
  std::map<std::uint32_t, std::uint32_t> registers_;
  std::vector<std::uint32_t> first_link_, link_;
  std::uint32_t loads_ = 0, sweeps_ = 0;
};

} // namespace hopmesh::tests
