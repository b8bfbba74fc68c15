// The firmware on an emulated 32-bit RISC-V core, on the very same bus.
#pragma once

#include "firmware/riscv/core_job.h"
#include "sim/levels/hosts/emulated/emulated_core.h"
#include "sim/levels/hosts/fixed_motion.h"

#include <optional>

namespace hopmesh::levels {

class Rv32Host : public StepHost {
 public:
  Rv32Host(const scene::HostSpec& host, const HostPlace& place);

  int open() override;
  int step(HostStep& step) override;
  const hm_driver& driver() const override { return driver_; }
  int restore(const std::vector<double>& weights, int shift) override;
  std::vector<HostFunction> functions() const override { return core_.counts().functions(); }
  std::uint64_t memory_bytes() const override { return core_.memory_bytes(); }

 private:
  /// An array of the motion and where the core keeps it.
  struct Shared {
    std::vector<double>* values;
    std::uint32_t address;
    bool goes_in; ///< a step begins with it; else it only comes back
  };

  /// An array of a motion in whole numbers.
  template <typename T> struct SharedWhole {
    std::vector<T>* values;
    std::uint32_t address;
  };

  template <typename T> std::uint32_t put(const T* values, std::size_t count);
  std::uint32_t share(std::vector<double>& values, bool goes_in);
  void put_mesh();
  void put_motion();
  void put_state();
  void put_fixed();
  void send();
  void fetch();
  void send_fixed();
  void fetch_fixed();
  void tell_driver();
  hm_core_job& job() { return *core_.at<hm_core_job>(job_); }

  const HostPlace place_;
  const CoreProgram program_;
  EmulatedCore core_;
  std::uint32_t job_;
  std::vector<Shared> shared_;
  std::optional<FixedMotion> fixed_; ///< where steps are made in whole numbers
  std::vector<SharedWhole<std::int32_t>> words_;
  std::vector<SharedWhole<std::int64_t>> wide_;
  std::uint32_t node_force_ = 0;
  hm_driver driver_{};
};

} // namespace hopmesh::levels
