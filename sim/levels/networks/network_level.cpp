#include "sim/levels/networks/network_level.h"

#include "sim/levels/eigen_vectors.h"
#include "sim/levels/networks/loaded_array.h"
#include "sim/levels/reference_check.h"

namespace hopmesh::levels {

namespace {

using reference::Vector;

class ReferenceLevel : public NetworkLevel {
 public:
  ReferenceLevel(const GivenNetwork& network, const spec::ArraySpec& array)
      : network_(network), order_(spec::phases_of(network.topology(), array.schedule)),
        neuron_(neuron_of(array.output)), V_(network.start()) {}

  spec::Relaxation relax(double threshold, std::uint32_t max_sweeps) override {
    reference::Relaxation end =
        reference::relax(network_.network(), order_, network_.start(), threshold, max_sweeps, neuron_);
    V_ = std::move(end.V);
    return {end.sweeps, end.converged, 0, 0};
  }
  void restart() override { V_ = network_.start(); }
  double sweep() override {
    const Vector before = V_;
    V_ = reference::relax(network_.network(), order_, V_, 0, 1, neuron_).V;
    return (V_ - before).cwiseAbs().maxCoeff();
  }
  const Vector& outputs() const override { return V_; }

 private:
  const GivenNetwork& network_;
  const reference::Order order_;
  const reference::Neuron neuron_;
  Vector V_;
};

std::size_t count_vanished(const std::vector<double>& given, const std::vector<double>& loaded) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < given.size(); ++k)
    if (given[k] != 0 && loaded[k] == 0) ++count;
  return count;
}

class ArrayLevel : public NetworkLevel {
 public:
  ArrayLevel(const GivenNetwork& network, const spec::ArraySpec& array, ArrayPort& port)
      : network_(network), array_(array), loaded_(port, network) {}

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

  // The memories keep what was loaded, so they are read once.
  std::optional<double> loaded_energy() override {
    if (array_.output == spec::Output::modified && array_.normaliser == spec::Normaliser::prescaled)
      return std::nullopt;
    if (!in_memory_) in_memory_ = network_.network_of(loaded_.weights(), loaded_.biases());
    return reference::network_energy(*in_memory_, V_);
  }

 private:
  const GivenNetwork& network_;
  const spec::ArraySpec array_;
  LoadedArray loaded_;
  std::optional<reference::Network> in_memory_;
  Vector V_;
};

} // namespace

std::unique_ptr<NetworkLevel> reference_level(const GivenNetwork& network, const spec::ArraySpec& array) {
  return std::make_unique<ReferenceLevel>(network, array);
}

std::unique_ptr<NetworkLevel> array_level(const GivenNetwork& network, const spec::ArraySpec& array,
                                          ArrayPort& port) {
  return std::make_unique<ArrayLevel>(network, array, port);
}

} // namespace hopmesh::levels
