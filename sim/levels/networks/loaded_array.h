// An array that holds one network: loaded by the firmware's driver and relaxed whole, then swept on, and read
// back as numbers.
#pragma once

#include "firmware/driver.h"
#include "sim/levels/array_port.h"
#include "sim/levels/built_mesh.h"
#include "sim/levels/bus_array.h"
#include "sim/levels/networks/given_network.h"

namespace hopmesh::levels {

/// A network cell by cell, as the firmware lays it out.
struct CellNetwork {
  std::vector<double> weight, bias, output; ///< output: the start
};

class LoadedArray {
 public:
  /// For the networks of a mesh's steps, or for a given one: each must outlive it.
  LoadedArray(ArrayPort& port, const BuiltMesh& mesh) : LoadedArray(port, mesh.firmware(), mesh.topology()) {}
  LoadedArray(ArrayPort& port, const GivenNetwork& network)
      : LoadedArray(port, network.firmware(), network.topology()) {}

  /// Throws as check() does, here and below. A network that is relaxed opens the array, if nobody did.
  void open();
  /// By the inputs of neurons that may still move from now on, not by how far outputs do.
  void stop_by_share(double share) { driver_.stop = {1, share}; }
  /// m of sweep after sweep, into the table of an array that has one.
  void put_momentum(const std::vector<double>& m);
  /// Loads the network and relaxes it from its start.
  spec::Relaxation relax(CellNetwork network, double threshold, std::uint32_t max_sweeps);
  /// Relaxes from these outputs with other biases beside the weights that it has.
  spec::Relaxation correct(std::vector<double> bias, const std::vector<double>& output, double threshold,
                           std::uint32_t max_sweeps);
  /// The largest bias that fits beside them.
  double room() { return hm_driver_room(&driver_); }
  /// Cycles in which the host has held the bus until now.
  std::uint64_t bus_cycles() const { return memories_.bus_cycles(); }
  bool is_loaded() const { return driver_.line.bus != nullptr; }

  // Of what is loaded:
  void put_outputs(const std::vector<double>& outputs);
  /// A further sweep; the largest |change| of an output. With momentum, a sweep depends on those before it:
  /// then the run since the last relax() or put_outputs() is made anew, and is a sweep longer, or `more`.
  double sweep(std::uint32_t more = 1);
  const std::vector<double>& outputs() const { return outputs_; }
  /// As the memories have them, in units of the network that was given.
  std::vector<double> weights() const;
  std::vector<double> biases() const;
  double last_place() const { return levels::last_place(driver_.state); } ///< of an output
  std::uint32_t clipped() const { return driver_.clipped; } ///< weights and biases that did not fit

 private:
  LoadedArray(ArrayPort& port, const hm_mesh& mesh, const spec::Topology& topology);
  spec::Relaxation next_sweep(std::uint32_t more);
  /// Of what a weight or a bias was multiplied with before it was rounded.
  double unit() const { return hm_power_of_two(-driver_.shift); }

  ArrayPort& port_;
  const hm_mesh& mesh_;
  const BusArray memories_;
  hm_driver driver_{};
  std::vector<std::uint32_t> buffer_;
  std::vector<double> outputs_;
  Codes start_; ///< of the run that sweep() goes on with
  std::uint32_t sweeps_ = 0;
};

} // namespace hopmesh::levels
