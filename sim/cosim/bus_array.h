// An array behind its bus as a judge uses it: load a job, run it whole or sweep by sweep, read everything
// back.
#pragma once

#include "firmware/bus.h"
#include "rtl_model/spec/relaxation.h"
#include "sim/cosim/array_job.h"

#include <stdexcept>

namespace hopmesh::cosim {

using Codes = std::vector<std::int32_t>;

/// A transfer or a wait failed; `error` is the bus's.
class BusFault : public std::runtime_error {
 public:
  explicit BusFault(int code);
  int error;
};

class BusArray {
 public:
  BusArray(const hm_bus& bus, const spec::Topology& topology) : bus_(bus), topology_(topology) {}

  /// Weights, biases and start.
  void load(const ArrayJob& job) const;
  void put_outputs(const Codes& codes) const;
  /// From where V is, until at rest or `max_sweeps`.
  spec::Relaxation run(std::uint32_t threshold, std::uint32_t max_sweeps) const;
  spec::Relaxation one_sweep() const { return run(0, 1); }

  Codes weights() const;
  Codes biases() const;
  Codes outputs() const;
  std::uint32_t read(std::uint32_t address) const;
  void write(std::uint32_t address, std::uint32_t word) const;

 private:
  Codes read_window(std::uint32_t base, std::size_t count) const;
  void write_window(std::uint32_t base, const Codes& codes) const;

  const hm_bus& bus_;
  const spec::Topology& topology_;
};

/// What stands in an array's memories and registers now, as a job that starts from `start`.
ArrayJob loaded_job(const hm_bus& bus, const spec::ArraySpec& array, const spec::Topology& topology,
                    Codes start);

} // namespace hopmesh::cosim
