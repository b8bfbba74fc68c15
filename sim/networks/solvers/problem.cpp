#include "sim/networks/solvers/problem.h"

#include <cmath>

namespace hopmesh::solvers {
namespace {

/// Numbers that the neurons that stay get, -1 for the others.
std::vector<Eigen::Index> numbers_of(const std::vector<Eigen::Index>& stay, Eigen::Index neurons) {
  std::vector<Eigen::Index> number(static_cast<std::size_t>(neurons), -1);
  for (std::size_t k = 0; k < stay.size(); ++k)
    number[static_cast<std::size_t>(stay[k])] = static_cast<Eigen::Index>(k);
  return number;
}

} // namespace

std::vector<Eigen::Index> reached_neurons(const Problem& problem) {
  const Vector N = normalisers(problem);
  std::vector<Eigen::Index> stay;
  for (Eigen::Index i = 0; i < N.size(); ++i)
    if (N[i] > 0) stay.push_back(i);
  return stay;
}

Problem reached(const Problem& problem) {
  const auto stay = reached_neurons(problem);
  const auto number = numbers_of(stay, problem.I.size());
  const auto count = static_cast<Eigen::Index>(stay.size());
  Problem small{Weights(count, count), Vector(count), Vector(count), {}, {}};
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < problem.I.size(); ++i) {
    if (number[i] < 0) continue;
    small.I[number[i]] = problem.I[i];
    small.start[number[i]] = problem.start[i];
    small.component.push_back(problem.component[i]);
    for (Weights::InnerIterator w(problem.W, i); w; ++w)
      if (number[w.col()] >= 0) entries.emplace_back(number[i], number[w.col()], w.value());
  }
  small.W.setFromTriplets(entries.begin(), entries.end());
  small.start = into_box(small.start);
  for (const auto& phase : problem.colours) {
    std::vector<std::uint32_t> left;
    for (const std::uint32_t i : phase)
      if (number[i] >= 0) left.push_back(static_cast<std::uint32_t>(number[i]));
    if (!left.empty()) small.colours.push_back(std::move(left));
  }
  return small;
}

Vector inputs(const Problem& problem, const Vector& V) {
  return problem.W * V + problem.I;
}

double input(const Problem& problem, const Vector& V, Eigen::Index neuron) {
  double s = problem.I[neuron];
  for (Weights::InnerIterator w(problem.W, neuron); w; ++w) s += w.value() * V[w.col()];
  return s;
}

Vector normalisers(const Problem& problem) {
  Vector N = problem.I.cwiseAbs();
  for (Eigen::Index i = 0; i < N.size(); ++i)
    for (Weights::InnerIterator w(problem.W, i); w; ++w) N[i] += std::abs(w.value());
  return N;
}

double rise(const Problem& problem, const Vector& s, const Vector& d) {
  return -s.dot(d) - d.dot(problem.W * d) / 2;
}

double kkt_violation(const Problem& problem, const Vector& V) {
  const Vector step = (inputs(problem, V).array() / normalisers(problem).array()).matrix();
  return (into_box(V + step) - V).lpNorm<Eigen::Infinity>();
}

} // namespace hopmesh::solvers
