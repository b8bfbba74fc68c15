// Every solver's own door: what network_solver.cpp puts names to. All but the first take convex problems
// only.
#pragma once

#include "sim/networks/solvers/network_solver.h"

namespace hopmesh::solvers {

/// How a neuron answers its input s. The Hopfield rule moves a share of the room it has, V += share R s / N;
/// the exact rule goes to the least energy that it alone can reach, V += share s / -W_ii, stopped by the box
/// (Gauss-Seidel; over-relaxed at a share above 1; Jacobi where all fire at once).
enum class Rule { hopfield, exact };
std::unique_ptr<Solver> make_neurons(const Problem& problem, Rule rule, double share, Order order);

/// Nesterov's momentum on projected gradient steps, restarted where it works against the way down.
std::unique_ptr<Solver> make_accelerated_gradient(const Problem& problem);
/// Conjugate gradients that respect the box (MPRGP): plain ones where no bound is met.
std::unique_ptr<Solver> make_conjugate_gradient(const Problem& problem);
/// Splitting into a linear solve and a clamp; rho = rho_share times the largest eigenvalue of -W.
std::unique_ptr<Solver> make_admm(const Problem& problem, double rho_share);
/// A single solve without the box.
std::unique_ptr<Solver> make_cholesky(const Problem& problem);
/// A gradient step finds the bounds, a sparse solve answers for the outputs between them.
std::unique_ptr<Solver> make_projected_newton(const Problem& problem);

} // namespace hopmesh::solvers
