// An array that costs nothing: it answers its registers, keeps its windows by memcpy, and is done at once
// with the outputs it was loaded with. What a step takes on it is the host's share alone.
#pragma once

#include "rtl_model/spec/memory_map.h"
#include "sim/levels/array_port.h"

#include <chrono>
#include <map>

namespace hopmesh::bench {

/// Seconds of wall time of the host's work, by what the bus sees of it.
struct HostSeconds {
  double network = 0;   ///< predict and build, until the driver's first transfer
  double load = 0;      ///< to codes and into the windows, until START
  double read_back = 0; ///< counters and outputs
  double motion = 0;    ///< probe and move, until the port is told that the step ended
};

class NullArray : public levels::ArrayPort {
 public:
  NullArray(const spec::ArraySpec& array, const spec::Topology& topology);

  int read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) override;
  int write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) override;
  int wait_for_irq() override;
  void begin_step(std::uint64_t) override { mark_ = Clock::now(); }
  void end_step(std::uint64_t) override { lap(seconds.motion); }

  HostSeconds seconds;

 private:
  using Clock = std::chrono::steady_clock;

  std::uint32_t* window(std::uint32_t address);
  std::uint32_t read_register(std::uint32_t offset);
  void lap(double& part);

  const spec::Topology& topology_;
  const spec::MemoryMap map_;
  std::vector<std::uint32_t> weight_, bias_, output_;
  std::map<std::uint32_t, std::uint32_t> registers_;
  std::uint32_t outputs_left_ = 0; ///< words of the read-back still to come
  bool loading_ = false;
  Clock::time_point mark_;
};

} // namespace hopmesh::bench
