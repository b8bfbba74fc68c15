#include "sim/levels/networks/network_level.h"

#include "sim/levels/eigen_vectors.h"
#include "sim/levels/networks/corrections.h"
#include "sim/levels/networks/loaded_array.h"
#include "sim/levels/reference_check.h"
#include "sim/reference/sweeper.h"

namespace hopmesh::levels {

namespace {

using reference::Vector;

class ReferenceLevel : public NetworkLevel {
 public:
  ReferenceLevel(const GivenNetwork& network, const spec::ArraySpec& array, const RelaxOptions& options)
      : network_(network), order_(spec::phases_of(network.topology(), array.schedule)),
        rule_(rule_of(array, options.momentum)), stop_{options.threshold, options.max_sweeps, options.share} {
    restart();
  }

  spec::Relaxation relax() override {
    restart();
    const reference::Relaxation end = reference::relax(*sweeper_, stop_);
    return {end.sweeps, end.converged, 0, 0};
  }
  Corrected refine(std::uint32_t most) override {
    reference::Relaxation answer{sweeper_->V(), 0, true};
    const reference::Refinement made =
        reference::refine(network_.network(), order_, network_.start(), stop_, rule_, most, answer);
    sweeper_.emplace(network_.network(), order_, rule_, answer.V);
    return {made.corrections, made.refused, made.residual, answer.sweeps, 0};
  }
  void restart() override { sweeper_.emplace(network_.network(), order_, rule_, network_.start()); }
  double sweep() override { return sweeper_->sweep().largest_change; }
  const Vector& outputs() const override { return sweeper_->V(); }

 private:
  const GivenNetwork& network_;
  const reference::Order order_;
  const reference::NeuronRule rule_;
  const reference::Stop stop_;
  std::optional<reference::Sweeper> sweeper_;
};

std::size_t count_vanished(const std::vector<double>& given, const std::vector<double>& loaded) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < given.size(); ++k)
    if (given[k] != 0 && loaded[k] == 0) ++count;
  return count;
}

class ArrayLevel : public NetworkLevel {
 public:
  ArrayLevel(const GivenNetwork& network, const spec::ArraySpec& array, const RelaxOptions& options,
             ArrayPort& port)
      : network_(network), array_(array), options_(options), loaded_(port, network) {}

  spec::Relaxation relax() override {
    loaded_.open();
    if (options_.share) loaded_.stop_by_share(*options_.share);
    if (!options_.momentum.empty()) loaded_.put_momentum(options_.momentum);
    const spec::Relaxation end =
        loaded_.relax({network_.rows(), values_of(network_.network().I), values_of(network_.start())},
                      options_.threshold, options_.max_sweeps);
    V_ = vector_of(loaded_.outputs());
    return end;
  }

  Corrected refine(std::uint32_t most) override {
    Corrected made;
    Corrections corrections(
        network_.network(), loaded_.room(), [&](const Vector& bias, const Vector& output) {
          const spec::Relaxation end =
              loaded_.correct(values_of(bias), values_of(output), options_.threshold, options_.max_sweeps);
          made.sweeps += end.sweeps, made.cycles += end.cycles;
          return vector_of(loaded_.outputs());
        });
    corrections.learn_from(network_.start(), V_);
    while (corrections.made() < most && corrections.correct(V_)) {
    }
    made.corrections = corrections.made(), made.refused = corrections.refused();
    made.residual = corrections.residual(V_);
    return made;
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
  const RelaxOptions options_;
  LoadedArray loaded_;
  std::optional<reference::Network> in_memory_;
  Vector V_;
};

} // namespace

std::unique_ptr<NetworkLevel> reference_level(const GivenNetwork& network, const spec::ArraySpec& array,
                                              const RelaxOptions& options) {
  return std::make_unique<ReferenceLevel>(network, array, options);
}

std::unique_ptr<NetworkLevel> array_level(const GivenNetwork& network, const spec::ArraySpec& array,
                                          const RelaxOptions& options, ArrayPort& port) {
  return std::make_unique<ArrayLevel>(network, array, options, port);
}

} // namespace hopmesh::levels
