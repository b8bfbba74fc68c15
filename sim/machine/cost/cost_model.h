// What an array costs without synthesis: each figure of a part is a sum of what it grows with, no weight
// below 0, fitted to measured arrays by the least relative squares; and how far off that is for arrays that
// it was not fitted to.
#pragma once

#include "sim/machine/cost/cost_points.h"

#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/topology.h"

namespace hopmesh::machine {

/// Weights, none below 0, that make rows times weights come to `values`: the sum of ((row w - v) / v)^2 is
/// least. Rows whose value is not above 0 are left out.
std::vector<double> least_squares(const std::vector<std::vector<double>>& rows,
                                  const std::vector<double>& values);

class CostModel {
 public:
  /// Learns from the fitted ones.
  explicit CostModel(const std::vector<CostPoint>& points);

  /// The point that such parameters would be.
  CostPoint predict(const Parameters& parameters) const;
  /// Of whole arrays, over the points that were held back: the largest |predicted / measured - 1|; NaN where
  /// none of them has the figure.
  double largest_error(Figure figure) const;
  /// Over which the error was taken.
  std::size_t held(Figure figure) const;

 private:
  double predicted(Part part, Figure figure, const std::vector<double>& features) const;

  const std::vector<CostPoint>* points_;
  std::vector<double> weights_[3][all_figures.size()];
};

/// Fitted to the points that the program comes with.
const CostModel& cost_model();

/// Parameters of an array for a network, as those of its RTL; an array without a fold has an element a
/// neuron, which chooses among as many links as its row has.
Parameters cost_parameters(const spec::ArraySpec& array, const spec::Topology& topology);

} // namespace hopmesh::machine
