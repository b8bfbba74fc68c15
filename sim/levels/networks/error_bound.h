// How far from the least of a definite network an array's outputs can be when a run ends by its own rule,
// from the formats alone and before any run (docs/method/theory.md, section 10).
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "sim/levels/networks/definite_part.h"

#include <optional>

namespace hopmesh::levels {

/// How relaxations of the array end, and what is known of them beforehand.
struct RunRules {
  double threshold = 0;             ///< of a stop by change
  std::optional<double> share = {}; ///< of a stop by sum, instead
  double largest_momentum = 1;      ///< of the table of m; counts with momentum
  /// The network is the host's, and what loading rounds counts, too; else it is as loaded.
  bool loads = false;
  /// R of the paper's stage where it rests is no less: 1/4 in incremental steps, whose scale grows where an
  /// output is beyond 3/4.
  double least_room = 0.25;
};

struct ErrorBound {
  bool link_is_state = false; ///< the case: else half a place of the coarser link weighs in every row
  /// Follows from the formats and the rule. Else it takes for granted that momentum's last sweep but one
  /// moved no output by more than twice the threshold.
  bool proved = false;
  double norm = 0; ///< rms over neurons, by the least curvature; outputs may be held at bounds
  /// Rms by |H^-1|, input by input, where the inverse was made: where no output ends at a bound.
  std::optional<double> each = {};

  double least() const { return each ? std::min(*each, norm) : norm; }
};

/// Bounds for one network and whatever array relaxes it in this order.
class ErrorBounds {
 public:
  /// The inverse takes n^2 numbers and n solves.
  static constexpr Eigen::Index most_inverted = 3000;

  /// `inverted`: for ErrorBound::each, where the network is no larger than most_inverted.
  ErrorBounds(const reference::Network& network, const reference::Order& order, bool inverted);

  bool definite() const { return curvature_ > 0; }
  /// None where the network is not definite or no rule holds: outputs are signs, rows are prescaled, the sums
  /// round, or R may vanish.
  std::optional<ErrorBound> of(const spec::ArraySpec& array, const RunRules& rules) const;

 private:
  struct Reach;
  void find_rows(const reference::Network& network, const reference::Order& order);
  void find_curvature(const reference::Network& network);
  void invert();
  Eigen::VectorXd most_input(const spec::ArraySpec& array, const RunRules& rules, const Reach& reach) const;
  Eigen::VectorXd moves(const spec::ArraySpec& array, const RunRules& rules) const;
  Eigen::VectorXd own_input(const spec::ArraySpec& array, const RunRules& rules, const Reach& reach) const;
  double sum_at_rest(const spec::ArraySpec& array, const RunRules& rules) const;
  double unit_of(const spec::ArraySpec& array) const;
  double rms_of(double norm) const;

  const std::vector<Eigen::Index> neurons_; ///< that have a weight; all below are over them
  const DefinitePart part_;
  reference::Matrix weight_;    ///< |W|
  reference::Matrix later_;     ///< of it, what fires no earlier than the row's neuron
  Eigen::VectorXd own_, sum_;   ///< |W_ii|, sum |W_ij|
  Eigen::VectorXd bias_, rest_; ///< |I|, |V*|
  Eigen::MatrixXd inverse_;     ///< |H^-1|; empty: not made
  double curvature_ = 0;        ///< no eigenvalue of H is less; 0: not definite
};

} // namespace hopmesh::levels
