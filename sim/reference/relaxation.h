// A network of neurons, how their outputs follow their inputs, and how it comes to rest:
// docs/method/theory.md, section 3.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <cstdint>
#include <optional>
#include <vector>

namespace hopmesh::reference {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Neurons are numbered components * node + p over ALL nodes (components: 3, or 2 for x and z in planar
/// meshes); rows, columns and entries of pinned nodes are empty and zero.
struct Network {
  Matrix W;
  Vector I;
};

/// Order in which neurons fire: one entry a phase; neurons of a phase all read the outputs from before it.
using Order = std::vector<std::vector<std::uint32_t>>;

/// What a neuron does with its input s.
enum class Neuron : std::uint8_t {
  modified,  ///< a step R s / N (paper eqs. 9 to 12)
  binary,    ///< the sign of s (paper eq. 3)
  projected, ///< a step omega s / |W_ii|, back into the box
  momentum   ///< all at once, a step s / sum |W_ij| from a point that the step before leads beyond
};

struct NeuronRule {
  Neuron neuron = Neuron::modified;
  double relaxation = 29.0 / 16; ///< omega; counts with `projected`, 0 to 2
  /// m of a run's sweeps, one after the other; the last one holds on. Counts with `momentum`; empty: none.
  std::vector<double> momentum = {};
  /// An output so near a bound stands there for others: the paper's neuron comes no further than near.
  double nearness = 0;
};

/// m_k = (t_k - 1) / t_(k+1) with t_0 = 1 and t_(k+1) = (1 + sqrt(1 + 4 t_k^2)) / 2 (Beck and Teboulle 2009).
std::vector<double> fista(std::size_t entries);

/// When a relaxation ends.
struct Stop {
  double threshold = 0; ///< behind a sweep in which no output moves by more
  std::uint32_t max_sweeps = 0;
  /// Instead of the threshold: behind a sweep in which no neuron that may still move has a larger |s| than
  /// this share of the largest in the run's first sweep. A neuron may not move that stands at a bound, by
  /// NeuronRule::nearness, and whose s pushes it there.
  std::optional<double> share = {};
};

struct Relaxation {
  Vector V;
  std::uint32_t sweeps = 0;
  bool converged = false;
};

/// From V (in the box [-1, 1]) until it may stop.
Relaxation relax(const Network& network, const Order& order, Vector V, const Stop& stop,
                 const NeuronRule& rule = {});
/// Until no output moves by more than threshold in a sweep, or max_sweeps.
Relaxation relax(const Network& network, const Order& order, Vector V, double threshold,
                 std::uint32_t max_sweeps, const NeuronRule& rule = {});

/// -1/2 V'WV - I'V.
double network_energy(const Network& network, const Vector& V);
/// Largest violation of the KKT conditions on the box [-1, 1]: how far a step of s_i / N_i can move V_i.
double kkt_violation(const Network& network, const Vector& V);
/// s of the neurons that may still move; 0 of those at a bound that s pushes against.
Vector movable_input(const Network& network, const Vector& V);
/// network_energy(from) - network_energy(to), with the digits that their difference loses.
double fall(const Network& network, const Vector& from, const Vector& to);

} // namespace hopmesh::reference
