#include "sim/machine/cost/cost_model.h"

#include "sim/machine/rtl/rtl_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hopmesh::machine {

namespace {

constexpr int rounds = 4000; ///< of the descent: far more than it takes to come to rest

/// What the descent asks of rows: sums of products of columns.
struct Normal {
  std::vector<std::vector<double>> a;
  std::vector<double> b;
};

Normal normal_of(const std::vector<std::vector<double>>& rows, const std::vector<double>& values) {
  const std::size_t n = rows.empty() ? 0 : rows.front().size();
  Normal m{std::vector<std::vector<double>>(n, std::vector<double>(n, 0)), std::vector<double>(n, 0)};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (!(values[r] > 0)) continue;
    for (std::size_t i = 0; i < n; ++i) {
      m.b[i] += rows[r][i] / values[r];
      for (std::size_t j = 0; j < n; ++j) m.a[i][j] += rows[r][i] * rows[r][j] / (values[r] * values[r]);
    }
  }
  return m;
}

} // namespace

// Weights go where they are best in turn: a descent that the bound at 0 does not hinder.
std::vector<double> least_squares(const std::vector<std::vector<double>>& rows,
                                  const std::vector<double>& values) {
  const Normal m = normal_of(rows, values);
  std::vector<double> weights(m.b.size(), 0);
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (!(m.a[i][i] > 0)) continue;
      double left = m.b[i];
      for (std::size_t j = 0; j < weights.size(); ++j)
        if (j != i) left -= m.a[i][j] * weights[j];
      weights[i] = std::max(0.0, left / m.a[i][i]);
    }
  return weights;
}

CostModel::CostModel(const std::vector<CostPoint>& points) : points_(&points) {
  for (std::size_t p = 0; p < part_names.size(); ++p)
    for (std::size_t f = 0; f < all_figures.size(); ++f) {
      std::vector<std::vector<double>> rows;
      std::vector<double> values;
      for (const CostPoint& point : points) {
        if (!point.fitted || std::isnan(point.parts[p][f])) continue;
        rows.push_back(features_of(Part(p), point.parameters));
        values.push_back(point.parts[p][f]);
      }
      weights_[p][f] = least_squares(rows, values);
    }
}

double CostModel::predicted(Part part, Figure figure, const std::vector<double>& features) const {
  const std::vector<double>& weights =
      weights_[static_cast<std::size_t>(part)][static_cast<std::size_t>(figure)];
  if (weights.empty()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * features[k];
  return sum;
}

CostPoint CostModel::predict(const Parameters& parameters) const {
  CostPoint point;
  point.parameters = parameters;
  for (std::size_t p = 0; p < part_names.size(); ++p) {
    const std::vector<double> features = features_of(Part(p), parameters);
    for (std::size_t f = 0; f < all_figures.size(); ++f)
      point.parts[p][f] = predicted(Part(p), Figure(f), features);
  }
  return point;
}

double CostModel::largest_error(Figure figure) const {
  double largest = std::numeric_limits<double>::quiet_NaN();
  for (const CostPoint& point : *points_) {
    const double measured = whole_figure(point, figure);
    if (point.fitted || std::isnan(measured) || !(measured > 0)) continue;
    const double error = std::abs(whole_figure(predict(point.parameters), figure) / measured - 1);
    largest = std::isnan(largest) ? error : std::max(largest, error);
  }
  return largest;
}

std::size_t CostModel::held(Figure figure) const {
  return static_cast<std::size_t>(std::count_if(points_->begin(), points_->end(), [&](const CostPoint& p) {
    return !p.fitted && whole_figure(p, figure) > 0;
  }));
}

const CostModel& cost_model() {
  static const CostModel model(shipped_points());
  return model;
}

Parameters cost_parameters(const spec::ArraySpec& array, const spec::Topology& topology) {
  spec::ArraySpec folded = array;
  const bool apart = !spec::is_folded(array);
  if (apart) folded.elements = static_cast<int>(topology.neurons()), folded.stages = spec::Stages::each;
  Parameters parameters;
  for (const RtlParameter& p : rtl_parameters(folded, rtl_room(folded, topology)))
    parameters[p.name] = static_cast<std::int64_t>(p.value);
  if (apart) parameters["SOURCES"] = static_cast<std::int64_t>(topology.most_taps());
  return parameters;
}

} // namespace hopmesh::machine
