// The array as one more solver of a step's network: level engine, swept one by one, judged in double by its
// raw outputs.
#pragma once

#include "firmware/driver.h"
#include "sim/cli/options.h"
#include "sim/cosim/bus_array.h"
#include "sim/rivals/quadratic/race.h"

namespace hopmesh::cli {

/// An array that holds one network. Vectors are numbered as quadratic::reached() does.
class StepArray {
 public:
  /// `whole`: the network over all nodes. It and `prepared` must outlive this.
  StepArray(const rivals::quadratic::Problem& whole, const Prepared& prepared);

  /// The first loads weights, biases and the start. Throws study::Stopped where the user stops it, and
  /// quadratic::Unfit where its outputs are binary.
  void sweep();
  rivals::quadratic::Vector outputs() const;
  double last_place() const { return hm_power_of_two(-hm_fraction_bits(&driver_.state)); }
  std::uint64_t cycles_per_sweep() const { return cycles_; }
  /// The network as its memories have it; none where rows were scaled one by one.
  std::optional<rivals::quadratic::Problem> loaded() const;

 private:
  void load_and_sweep();

  const rivals::quadratic::Problem& whole_;
  const Prepared& prepared_;
  const std::unique_ptr<study::ArrayPort> port_;
  const cosim::BusArray there_;
  hm_driver driver_{};
  std::vector<std::uint32_t> buffer_;
  std::vector<double> output_; ///< cell by cell
  std::uint64_t cycles_ = 0;
};

/// One course of it, on until it stands still; `problem` is what reached() leaves of the array's.
rivals::quadratic::Course run_array(StepArray& array, const rivals::quadratic::Problem& problem,
                                    const rivals::quadratic::Answer& answer, rivals::quadratic::Limits limits,
                                    const std::atomic<bool>& stop);

/// Where it came lowest, and what keeps it from the answer, in lines for people.
std::string stall_text(const StepArray& array, const rivals::quadratic::Course& course,
                       const rivals::quadratic::Problem& problem, const rivals::quadratic::Answer& answer);

} // namespace hopmesh::cli
