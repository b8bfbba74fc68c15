#include "sim/networks/network_level.h"

#include "firmware/driver.h"
#include "sim/cosim/bus_array.h"
#include "sim/levels/array_motion.h"

namespace hopmesh::networks {

namespace {

using reference::Vector;

class ReferenceLevel : public NetworkLevel {
 public:
  ReferenceLevel(const GivenNetwork& network, const spec::ArraySpec& array)
      : network_(network), order_(spec::phases_of(network.topology(), array.schedule)), output_(array.output),
        V_(network.start()) {}

  Rest relax(double threshold, std::uint32_t max_sweeps) override {
    reference::Relaxation end =
        reference::relax(network_.network(), order_, network_.start(), threshold, max_sweeps, output_);
    V_ = std::move(end.V);
    return {end.sweeps, end.converged, 0, 0};
  }
  void restart() override { V_ = network_.start(); }
  double sweep() override {
    const Vector before = V_;
    V_ = reference::relax(network_.network(), order_, V_, 0, 1, output_).V;
    return (V_ - before).cwiseAbs().maxCoeff();
  }
  const Vector& outputs() const override { return V_; }

 private:
  const GivenNetwork& network_;
  const reference::Order order_;
  const spec::Output output_;
  Vector V_;
};

void must(int error) {
  if (error == HM_ERROR_STOPPED) throw levels::Stopped();
  if (error != HM_OK) throw std::runtime_error(levels::error_text(error));
}

class ArrayLevel : public NetworkLevel {
 public:
  ArrayLevel(const GivenNetwork& network, const spec::ArraySpec& array, levels::ArrayPort& port)
      : network_(network), array_(array), port_(port), there_(port.bus(), network.topology()), buffer_(4096),
        V_(network.start()) {}

  Rest relax(double threshold, std::uint32_t max_sweeps) override {
    if (!driver_.bus)
      must(hm_driver_open(&driver_, &port_.bus(), &network_.firmware(), buffer_.data(),
                          static_cast<std::uint32_t>(buffer_.size())));
    std::vector<double> rows = network_.rows();
    Vector bias = network_.network().I;
    V_ = network_.start();
    hm_network loaded{rows.data(), bias.data(), V_.data()};
    hm_relaxation end;
    must(hm_driver_relax(&driver_, &network_.firmware(), &loaded, threshold, max_sweeps, &end));
    return {end.sweeps, end.converged != 0, end.cycles, driver_.clipped};
  }

  void restart() override {
    V_ = network_.start();
    cosim::Codes codes(static_cast<std::size_t>(V_.size()));
    hm_codes(V_.data(), static_cast<std::uint32_t>(codes.size()), 1 / last_place(driver_.state),
             &driver_.state, reinterpret_cast<std::uint32_t*>(codes.data()));
    there_.put_outputs(codes);
  }

  double sweep() override try {
    const spec::Relaxation end = there_.one_sweep();
    const auto values = counted(there_.outputs(), last_place(driver_.state));
    V_ = Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
    return end.largest_change * last_place(driver_.state);
  } catch (const cosim::BusFault& fault) {
    must(fault.error);
    throw;
  }

  const Vector& outputs() const override { return V_; }

  std::optional<reference::Network> loaded() const override {
    if (array_.output == spec::Output::modified && array_.normaliser == spec::Normaliser::prescaled)
      return std::nullopt;
    const double unit = hm_power_of_two(-driver_.shift);
    return network_.network_of(counted(there_.weights(), unit * last_place(driver_.weight)),
                               counted(there_.biases(), unit * last_place(driver_.bias)));
  }

 private:
  static double last_place(const hm_format& format) { return hm_power_of_two(-hm_fraction_bits(&format)); }
  static std::vector<double> counted(const cosim::Codes& codes, double place) {
    std::vector<double> values(codes.begin(), codes.end());
    for (double& value : values) value *= place;
    return values;
  }

  const GivenNetwork& network_;
  const spec::ArraySpec array_;
  levels::ArrayPort& port_;
  const cosim::BusArray there_;
  hm_driver driver_{};
  std::vector<std::uint32_t> buffer_;
  Vector V_;
};

} // namespace

std::unique_ptr<NetworkLevel> reference_level(const GivenNetwork& network, const spec::ArraySpec& array) {
  return std::make_unique<ReferenceLevel>(network, array);
}

std::unique_ptr<NetworkLevel> array_level(const GivenNetwork& network, const spec::ArraySpec& array,
                                          levels::ArrayPort& port) {
  return std::make_unique<ArrayLevel>(network, array, port);
}

} // namespace hopmesh::networks
