#include "sim/levels/networks/loaded_array.h"

#include "firmware/registers.h"
#include "sim/levels/bus_error.h"

namespace hopmesh::levels {

LoadedArray::LoadedArray(ArrayPort& port, const hm_mesh& mesh, const spec::Topology& topology)
    : port_(port), mesh_(mesh), memories_(port.bus(), topology), buffer_(4096) {}

void LoadedArray::open() {
  check_opened(hm_driver_open(&driver_, &port_.bus(), &mesh_, buffer_.data(),
                              static_cast<std::uint32_t>(buffer_.size())),
               driver_);
}

void LoadedArray::put_momentum(const std::vector<double>& m) {
  check(hm_driver_put_momentum(&driver_, m.data(), static_cast<std::uint32_t>(m.size())));
}

spec::Relaxation LoadedArray::relax(CellNetwork network, double threshold, std::uint32_t max_sweeps) {
  if (!is_loaded()) open();
  start_ = to_codes(network.output, driver_.state);
  hm_network loaded{network.weight.data(), network.bias.data(), network.output.data()};
  hm_relaxation end;
  check(hm_driver_relax(&driver_, &mesh_, &loaded, threshold, max_sweeps, &end));
  outputs_ = std::move(network.output);
  sweeps_ = end.sweeps;
  return memories_.last_run();
}

spec::Relaxation LoadedArray::correct(std::vector<double> bias, const std::vector<double>& output,
                                      double threshold, std::uint32_t max_sweeps) {
  start_ = to_codes(output, driver_.state);
  outputs_ = output;
  hm_network asked{nullptr, bias.data(), outputs_.data()};
  hm_relaxation end;
  check(hm_driver_correct(&driver_, &mesh_, &asked, threshold, max_sweeps, &end));
  sweeps_ = end.sweeps;
  return memories_.last_run();
}

void LoadedArray::put_outputs(const std::vector<double>& outputs) {
  outputs_ = outputs;
  start_ = to_codes(outputs, driver_.state);
  sweeps_ = 0;
  memories_.put_outputs(start_);
}

spec::Relaxation LoadedArray::next_sweep(std::uint32_t more) {
  sweeps_ += more;
  if (driver_.output != HM_OUTPUT_MOMENTUM) return memories_.run(0, more);
  memories_.put_outputs(start_);
  return memories_.run(memories_.threshold(), sweeps_);
}

double LoadedArray::sweep(std::uint32_t more) {
  const double change = next_sweep(more).largest_change * last_place();
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
