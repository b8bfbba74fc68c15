#include "sim/levels/networks/error_bound.h"

#include "firmware/quantise.h"
#include "sim/levels/networks/told_error.h"

#include <cmath>

namespace hopmesh::levels {

using Eigen::Index;
using Eigen::VectorXd;
using spec::NumberFormat, spec::Rounding, spec::Output;

namespace {

double place_of(const NumberFormat& format) {
  return std::ldexp(1.0, -format.fraction_bits());
}

/// The most that rounding to the format moves a number by.
double loss_of(const NumberFormat& format) {
  const bool cuts = format.rounding == Rounding::trn || format.rounding == Rounding::trn_zero;
  return (cuts ? 1 : 0.5) * place_of(format);
}

/// The most that it makes a step longer by.
double excess_of(const NumberFormat& format) {
  return format.rounding == Rounding::trn_zero ? 0 : loss_of(format);
}

/// What is lost where u becomes a step of the state: R u is a product, u alone may fit as it is.
double step_loss_of(const spec::ArraySpec& array) {
  const bool fits = array.formats.drive.fraction_bits() <= array.formats.state.fraction_bits();
  return array.output != Output::modified && fits ? 0 : loss_of(array.formats.state);
}

/// A truncated reciprocal shortens a quotient by at most this factor.
double stretch_of(const spec::ArraySpec& array) {
  return spec::has_reciprocal(array) ? 1 / (1 - std::ldexp(1.0, 2 - array.reciprocal_bits)) : 1;
}

double threshold_of(const spec::ArraySpec& array, double threshold) {
  const double place = place_of(array.formats.state);
  return std::floor(threshold / place) * place;
}

/// How far the last sweep of momentum went from Y, where it moved V by no more than the threshold: the sweep
/// before put Y so far ahead.
double step_of_momentum(double threshold, double momentum) {
  constexpr double sweep_before = 2; // thresholds
  return threshold * (1 + momentum * sweep_before);
}

bool is_bounded(const spec::ArraySpec& array, const RunRules& rules) {
  if (array.output == Output::binary || !array.exact_accumulator) return false;
  if (array.output != Output::modified) return true;
  return array.normaliser != spec::Normaliser::prescaled && rules.least_room > 0;
}

} // namespace

/// Where outputs can be, and what the host's numbers become when they are loaded.
struct ErrorBounds::Reach {
  VectorXd room;               ///< R, at least
  VectorXd output;             ///< |V|, at most
  double weight = 0, bias = 0; ///< what rounding moves one of them by, at most
};

ErrorBounds::ErrorBounds(const reference::Network& network, const reference::Order& order, bool inverted)
    : neurons_(weighed_neurons(network)), part_(network.W, neurons_, 0) {
  if (neurons_.empty() || !part_.positive()) return;
  find_rows(network, order);
  find_curvature(network);
  if (inverted && definite() && static_cast<Index>(neurons_.size()) <= most_inverted) invert();
}

void ErrorBounds::find_rows(const reference::Network& network, const reference::Order& order) {
  const auto n = static_cast<Index>(neurons_.size());
  std::vector<Index> place(static_cast<std::size_t>(network.I.size()), -1);
  std::vector<std::size_t> phase(place.size(), 0);
  for (Index k = 0; k < n; ++k) place[neurons_[k]] = k;
  for (std::size_t k = 0; k < order.size(); ++k)
    for (const std::uint32_t neuron : order[k]) phase[neuron] = k;
  std::vector<Eigen::Triplet<double>> all, later;
  own_ = sum_ = bias_ = VectorXd::Zero(n);
  VectorXd I(n);
  for (Index k = 0; k < n; ++k) {
    const Index i = neurons_[k];
    I[k] = network.I[i];
    for (reference::Matrix::InnerIterator w(network.W, i); w; ++w) {
      if (w.value() == 0) continue;
      const double size = std::abs(w.value());
      all.emplace_back(k, place[w.col()], size);
      sum_[k] += size;
      if (w.col() == i) own_[k] = size;
      if (w.col() != i && phase[w.col()] >= phase[i]) later.emplace_back(k, place[w.col()], size);
    }
  }
  weight_.resize(n, n), later_.resize(n, n);
  weight_.setFromTriplets(all.begin(), all.end());
  later_.setFromTriplets(later.begin(), later.end());
  bias_ = I.cwiseAbs();
  rest_ = part_.solve(I).cwiseAbs();
}

// Inverse iteration comes from above: so much less is taken, and a factorisation proves it.
void ErrorBounds::find_curvature(const reference::Network& network) {
  constexpr int iterations = 100;
  constexpr double enough = 1e-3;
  VectorXd x(static_cast<Index>(neurons_.size()));
  for (Index i = 0; i < x.size(); ++i) x[i] = 1 + std::fmod(0.618034 * static_cast<double>(i), 1);
  double found = 0;
  for (int k = 0; k < iterations; ++k) {
    x = part_.solve(x.normalized());
    const double now = 1 / x.norm();
    const bool ends = std::abs(now - found) <= enough * now;
    found = now;
    if (ends) break;
  }
  for (const double part : {0.98, 0.9, 0.5, 0.1})
    if (DefinitePart(network.W, neurons_, -part * found).positive()) {
      curvature_ = part * found;
      return;
    }
}

void ErrorBounds::invert() {
  const auto n = static_cast<Index>(neurons_.size());
  inverse_.resize(n, n);
  for (Index k = 0; k < n; ++k) inverse_.col(k) = part_.solve(VectorXd::Unit(n, k)).cwiseAbs();
}

/// What a code of 1.0 stands for: the driver's power of two, which takes the largest weight and bias into
/// their formats.
double ErrorBounds::unit_of(const spec::ArraySpec& array) const {
  const auto room = [](double largest, const NumberFormat& f) {
    const hm_format format{f.width, f.integer_bits, static_cast<int>(f.rounding),
                           static_cast<int>(f.overflow)};
    return largest > 0 ? hm_room(largest, &format) : 1000;
  };
  const double weight = weight_.coeffs().maxCoeff(), bias = bias_.maxCoeff();
  return hm_power_of_two(-std::min(room(weight, array.formats.weight), room(bias, array.formats.bias)));
}

double ErrorBounds::rms_of(double norm) const {
  return norm / std::sqrt(static_cast<double>(neurons_.size()));
}

/// |s| that a stop by sum leaves of any neuron, as the links show it: what a place of the link is worth, or
/// the share of the first sweep's, which is no more than N.
double ErrorBounds::sum_at_rest(const spec::ArraySpec& array, const RunRules& rules) const {
  const double first = (sum_ + bias_).maxCoeff();
  const double share = *rules.share > 0 ? std::exp2(std::floor(std::log2(*rules.share))) : 0;
  return std::max(place_of(array.formats.link) * sum_.maxCoeff(), share * first);
}

/// What an output moves by in the last sweep, from the point that links show.
VectorXd ErrorBounds::moves(const spec::ArraySpec& array, const RunRules& rules) const {
  const auto n = static_cast<Index>(neurons_.size());
  const double threshold = threshold_of(array, rules.threshold);
  if (!rules.share && array.output == Output::momentum)
    return VectorXd::Constant(n, step_of_momentum(threshold, rules.largest_momentum));
  if (!rules.share) return VectorXd::Constant(n, threshold);
  constexpr double whole_room = 2;
  const double s = sum_at_rest(array, rules), lost = loss_of(array.formats.drive);
  VectorXd step = VectorXd::Zero(n);
  for (Index i = 0; i < n; ++i) {
    if (array.output == Output::modified) step[i] = whole_room * (s / (sum_[i] + bias_[i]) + lost);
    if (array.output == Output::momentum) step[i] = s / sum_[i] + lost;
    if (array.output == Output::projected) step[i] = array.relaxation / 16.0 * s / own_[i] + lost;
  }
  return step.array() + loss_of(array.formats.state);
}

/// |s| that a neuron can have had when it fired in the last sweep, as the links showed it.
VectorXd ErrorBounds::own_input(const spec::ArraySpec& array, const RunRules& rules,
                                const Reach& reach) const {
  const auto n = static_cast<Index>(neurons_.size());
  if (rules.share) return VectorXd::Constant(n, sum_at_rest(array, rules));
  const double drive = loss_of(array.formats.drive);
  const double step = moves(array, rules).maxCoeff() + step_loss_of(array);
  VectorXd most(n);
  for (Index i = 0; i < n; ++i) {
    const double rounded = reach.weight * static_cast<double>(weight_.row(i).nonZeros());
    if (array.output == Output::modified)
      most[i] = (sum_[i] + bias_[i] + rounded + reach.bias) * (step / reach.room[i] + drive);
    if (array.output == Output::momentum) most[i] = (sum_[i] + rounded) * (step + drive);
    if (array.output == Output::projected)
      most[i] = (own_[i] + reach.weight) * (step + drive) * 16.0 / array.relaxation;
  }
  return stretch_of(array) * most;
}

/// |s| at rest, of the host's network: as the neuron fired, what others moved by afterwards, what its own
/// rounded move may have overshot by, what the links hid, and what loading rounded.
VectorXd ErrorBounds::most_input(const spec::ArraySpec& array, const RunRules& rules,
                                 const Reach& reach) const {
  VectorXd most = own_input(array, rules, reach) + later_ * moves(array, rules);
  most += own_ * (excess_of(array.formats.state) + 2 * excess_of(array.formats.drive));
  if (place_of(array.formats.link) > place_of(array.formats.state))
    most += sum_ * loss_of(array.formats.link);
  for (Index i = 0; i < most.size() && reach.weight > 0; ++i) {
    for (reference::Matrix::InnerIterator w(weight_, i); w; ++w)
      most[i] += reach.weight * reach.output[w.col()];
    most[i] += reach.bias;
  }
  return most;
}

// Where outputs can be is known better with every bound that holds.
std::optional<ErrorBound> ErrorBounds::of(const spec::ArraySpec& array, const RunRules& rules) const {
  if (!definite() || !is_bounded(array, rules)) return std::nullopt;
  constexpr int rounds = 4;
  const auto n = static_cast<Index>(neurons_.size());
  Reach reach{VectorXd::Constant(n, rules.least_room), VectorXd::Ones(n)};
  if (rules.loads) {
    reach.weight = unit_of(array) * loss_of(array.formats.weight);
    reach.bias = unit_of(array) * loss_of(array.formats.bias);
  }
  ErrorBound bound;
  bound.link_is_state = !(place_of(array.formats.link) > place_of(array.formats.state));
  bound.proved = array.output != Output::momentum || rules.share || rules.largest_momentum == 0 ||
                 threshold_of(array, rules.threshold) == 0;
  for (int k = 0; k < rounds; ++k) {
    const VectorXd input = most_input(array, rules, reach);
    const double far = input.norm() / curvature_;
    VectorXd around = VectorXd::Constant(n, far);
    bound.norm = rms_of(far);
    if (inverse_.size() > 0) {
      const VectorXd each = inverse_ * input;
      bound.each = rms_of(each.norm());
      around = around.cwiseMin(each);
    }
    reach.output = (rest_ + around).cwiseMin(1);
    reach.room = (1 - reach.output.array() - threshold_of(array, rules.threshold)).max(rules.least_room);
  }
  return bound;
}

} // namespace hopmesh::levels
