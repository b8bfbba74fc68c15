#include "sim/networks/network_level.h"

#include "sim/networks/loaded_array.h"

namespace hopmesh::networks {

namespace {

using reference::Vector;

class ReferenceLevel : public NetworkLevel {
 public:
  ReferenceLevel(const GivenNetwork& network, const spec::ArraySpec& array)
      : network_(network), order_(spec::phases_of(network.topology(), array.schedule)), output_(array.output),
        V_(network.start()) {}

  spec::Relaxation relax(double threshold, std::uint32_t max_sweeps) override {
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

Vector vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

std::vector<double> values_of(const Vector& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

std::size_t count_vanished(const std::vector<double>& given, const std::vector<double>& loaded) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < given.size(); ++k)
    if (given[k] != 0 && loaded[k] == 0) ++count;
  return count;
}

class ArrayLevel : public NetworkLevel {
 public:
  ArrayLevel(const GivenNetwork& network, const spec::ArraySpec& array, levels::ArrayPort& port)
      : network_(network), array_(array), loaded_(port, network.firmware(), network.topology()) {}

  spec::Relaxation relax(double threshold, std::uint32_t max_sweeps) override {
    const spec::Relaxation end =
        loaded_.relax({network_.rows(), values_of(network_.network().I), values_of(network_.start())},
                      threshold, max_sweeps);
    V_ = vector_of(loaded_.outputs());
    return end;
  }

  void restart() override {
    V_ = network_.start();
    loaded_.put_outputs(values_of(V_));
  }

  double sweep() override {
    const double change = loaded_.sweep();
    V_ = vector_of(loaded_.outputs());
    return change;
  }

  const Vector& outputs() const override { return V_; }
  std::uint32_t clipped() const override { return loaded_.clipped(); }
  std::size_t vanished() const override {
    return count_vanished(network_.rows(), loaded_.weights()) +
           count_vanished(values_of(network_.network().I), loaded_.biases());
  }

  std::optional<reference::Network> loaded() const override {
    if (array_.output == spec::Output::modified && array_.normaliser == spec::Normaliser::prescaled)
      return std::nullopt;
    return network_.network_of(loaded_.weights(), loaded_.biases());
  }

 private:
  const GivenNetwork& network_;
  const spec::ArraySpec array_;
  LoadedArray loaded_;
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
