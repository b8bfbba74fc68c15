#include "sim/levels/networks/loaded_array.h"

#include "sim/levels/bus_error.h"

namespace hopmesh::levels {

LoadedArray::LoadedArray(ArrayPort& port, const hm_mesh& mesh, const spec::Topology& topology)
    : port_(port), mesh_(mesh), memories_(port.bus(), topology), buffer_(4096) {}

spec::Relaxation LoadedArray::relax(CellNetwork network, double threshold, std::uint32_t max_sweeps) {
  if (!is_loaded())
    check_opened(hm_driver_open(&driver_, &port_.bus(), &mesh_, buffer_.data(),
                                static_cast<std::uint32_t>(buffer_.size())),
                 driver_);
  hm_network loaded{network.weight.data(), network.bias.data(), network.output.data()};
  hm_relaxation end;
  check(hm_driver_relax(&driver_, &mesh_, &loaded, threshold, max_sweeps, &end));
  outputs_ = std::move(network.output);
  return memories_.last_run();
}

void LoadedArray::put_outputs(const std::vector<double>& outputs) {
  outputs_ = outputs;
  memories_.put_outputs(to_codes(outputs, driver_.state));
}

double LoadedArray::sweep() {
  const double change = memories_.one_sweep().largest_change * last_place();
  outputs_ = to_doubles(memories_.outputs(), last_place());
  return change;
}

std::vector<double> LoadedArray::weights() const {
  return to_doubles(memories_.weights(), unit() * levels::last_place(driver_.weight));
}

std::vector<double> LoadedArray::biases() const {
  return to_doubles(memories_.biases(), unit() * levels::last_place(driver_.bias));
}

} // namespace hopmesh::levels
