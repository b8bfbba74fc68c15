// A level that relaxes a given network: the reference in double, or an array behind the firmware's driver.
#pragma once

#include "rtl_model/spec/relaxation.h"
#include "rtl_model/spec/schedule.h"
#include "sim/levels/array_port.h"
#include "sim/levels/networks/given_network.h"

#include <memory>
#include <optional>

namespace hopmesh::levels {

/// How a given network is relaxed.
struct RelaxOptions {
  double threshold = 1e-4; ///< until no output moves by more in a sweep
  std::uint32_t max_sweeps = 10'000;
  /// Instead of the threshold: of the first sweep's largest |s| of a neuron that may still move.
  std::optional<double> share = {};
  /// m of an array with momentum, sweep by sweep; empty: the sequence of docs/method/theory.md.
  std::vector<double> momentum = {};
};

/// What corrections of a relaxation came to; their sweeps and cycles, of an array, are beside its own.
struct Corrected {
  std::uint32_t corrections = 0, refused = 0; ///< kept; not kept, since the energy would have risen
  double residual = 0; ///< largest |s| of neurons that may still move, over the largest |I|
  std::uint64_t sweeps = 0, cycles = 0;
};

class NetworkLevel {
 public:
  virtual ~NetworkLevel() = default;
  /// From the start. The reference has neither cycles nor codes: they are 0. Throws Stopped where the user
  /// stops an array.
  virtual spec::Relaxation relax() = 0;
  /// Corrects what relax() came to by its residual in double, at most so often; no sweep() of the same run
  /// follows.
  virtual Corrected refine(std::uint32_t most) = 0;
  /// Puts the start back.
  virtual void restart() = 0;
  /// Another sweep, of the same run where it matters; the largest |change| of an output.
  virtual double sweep() = 0;
  virtual const Eigen::VectorXd& outputs() const = 0;
  /// Weights and biases that did not fit the formats of an array.
  virtual std::uint32_t clipped() const { return 0; }
  /// Energy of the outputs in the network as it stands in an array's memories, in units of the one that was
  /// given; none where there are no memories, or rows were scaled one by one.
  virtual std::optional<double> loaded_energy() { return std::nullopt; }
  /// Weights and biases that are not 0 and became 0 in the formats of an array.
  virtual std::size_t vanished() const { return 0; }
};

std::unique_ptr<NetworkLevel> reference_level(const GivenNetwork& network, const spec::ArraySpec& array,
                                              const RelaxOptions& options);
std::unique_ptr<NetworkLevel> array_level(const GivenNetwork& network, const spec::ArraySpec& array,
                                          const RelaxOptions& options, ArrayPort& port);

} // namespace hopmesh::levels
