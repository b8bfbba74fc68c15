#include "sim/reference/judgement.h"

#include "sim/reference/rest.h"

namespace hopmesh::reference {
namespace {

// A fall that is only the rounding of what the energy is summed from is none.
double gap(double left, double fall, double terms) {
  return fall > 0x1p-52 * terms ? left / fall : 0;
}

/// sum_ij |W_ij| + sum_i |I_i|: what an energy's terms come to at most.
double largest_terms(const BlockNetwork& network) {
  const auto sum = [&](const Quads& quads) { return network.gathered(quads).cwiseAbs().sum(); };
  return sum(network.magnitude()) + sum(network.bias());
}

} // namespace

Judgement judge_answer(const BlockNetwork& network, Vector same_sweeps, const Answer& answer) {
  Judgement judgement;
  judgement.same_sweeps = std::move(same_sweeps);
  judgement.rest = rest_from(network, judgement.same_sweeps).V;
  double left = energy_above(network, judgement.rest, answer.V);
  if (left < 0) {
    const Vector deeper = rest_from(network, answer.V).V;
    if (energy_above(network, judgement.rest, deeper) < 0) judgement.rest = deeper;
    left = energy_above(network, judgement.rest, answer.V);
  }
  const double fall = energy_above(network, judgement.rest, answer.start);
  judgement.gap = gap(left, fall, largest_terms(network));
  return judgement;
}

Judgement judge_signs(const Network& network, const Order& order, const Answer& answer,
                      std::uint32_t most_sweeps) {
  const auto relaxed = [&](const Vector& from, std::uint32_t sweeps) {
    return relax(network, order, from, 0, sweeps, {Neuron::binary}).V;
  };
  Judgement judgement;
  judgement.same_sweeps = relaxed(answer.start, answer.sweeps);
  judgement.rest = relaxed(judgement.same_sweeps, most_sweeps);
  const double rest = network_energy(network, judgement.rest);
  const double fall = network_energy(network, answer.start) - rest;
  if (fall > 0) judgement.gap = (network_energy(network, answer.V) - rest) / fall;
  return judgement;
}

} // namespace hopmesh::reference
