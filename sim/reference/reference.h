// The algorithm in double precision with Eigen: the readable definition, written from docs/method/theory.md
// alone. The reference shares no arithmetic with the firmware or the array; that they agree is evidence.
#pragma once

#include "sim/reference/refinement.h"
#include "sim/scene/mesh.h"

#include <functional>
#include <string_view>
#include <vector>

namespace hopmesh::reference {

/// Whoever answers a network otherwise than relax() does: from V0, in the step so numbered.
using Answerer = std::function<Relaxation(const Network& network, const Order& order, const Vector& V0,
                                          std::uint64_t step)>;

struct Formulation;
extern const Formulation probe, backward_euler, bdf2, statics;

struct StepParameters {
  const Formulation* formulation = &probe;
  NeuronRule rule = {};
  double mass = 1, drag = 0; ///< kg of a node; 1/s
  double time_step, friction, gamma, beta, acceleration_memory;
  bool energy_of_all_springs, force_on_acceleration;
  Eigen::Vector3d force;
  Vector node_force; ///< incremental: [3 * nodes], each node's own beside it; empty: none
  double threshold;
  std::uint32_t max_sweeps, expansions;
  std::optional<double> share = {}; ///< of the first sweep's |s|, by which to stop; none: by the threshold
  std::uint32_t refinements = 0;    ///< corrections of an expansion's answer; incremental
  Answerer answer = nullptr;        ///< none: relax() until stop()

  Stop stop() const { return {threshold, max_sweeps, share}; }
};

/// Motion of a scene; force is gravity plus wind.
StepParameters step_parameters(const scene::Scene& scene);

/// Positions, velocities, accelerations: [3 * nodes], node by node. In the incremental formulation the
/// acceleration is what the springs added to the prediction, da = sigma V; in a static step, how far it went.
struct State {
  Vector position, velocity, acceleration;
  Vector previous_position, previous_velocity; ///< a step before, for who looks back; else empty
  Vector V; ///< [components * nodes] rest state of the step before; zero at first
  std::uint64_t step = 0;
};

State initial_state(const scene::Mesh& mesh, const Formulation& formulation = probe);

// ---- probe (docs/method/theory.md, sections 1, 2, 4)

/// C of docs/method/theory.md, section 1: [3 * nodes].
Vector predict(const scene::Mesh& mesh, const StepParameters& motion, const State& state);
/// V0 of a step: the previous rest state scaled to unit length node by node, (0, 0, -1) where it is shorter
/// than 1e-9.
Vector expansion_point(const scene::Mesh& mesh, const State& state);
/// E(V) of docs/method/theory.md, section 1 (paper eq. 15).
double energy(const scene::Mesh& mesh, const StepParameters& motion, const Vector& predicted,
              const Vector& V);
/// What all springs hold: sum of alpha (|x_i - x_j| - L)^2, or of their constant pull's work.
double spring_energy(const scene::Mesh& mesh, const Vector& position);
/// W = -H, I = H V0 - g of docs/method/theory.md, section 2, about V0.
Network network(const scene::Mesh& mesh, const StepParameters& motion, const Vector& predicted,
                const Vector& V0);

// ---- incremental potential (docs/method/theory.md, section 4)

/// What one step minimises: inertia about a prediction, and the springs.
struct Increment {
  Vector predicted;       ///< C, [3 * nodes]
  double h;               ///< x = C + h da, s^2
  double inertia;         ///< of one node, kg/s^2; 0 in a static step
  Vector load = {};       ///< static step: newtons on every free node, [3 * nodes]; else empty, C knows them
  bool two_steps = false; ///< BDF2, with a step behind it
};
Increment increment(const scene::Mesh& mesh, const StepParameters& motion, const State& state);
/// Phi(V) at outputs that stand for da = scale V; less the work of the load in a static step.
double energy(const scene::Mesh& mesh, const Increment& increment, double scale, const Vector& V);
/// Its second-order expansion about V0, with compressed springs counted convex: W is negative semi-definite.
Network network(const scene::Mesh& mesh, const Increment& increment, double scale, const Vector& V0);
/// da of the step before over the scale.
Vector expansion_point(const scene::Mesh& mesh, const State& state, double scale);

/// What one step did, for records and for `network --step`: V0 and network of the last expansion, and the
/// rest it relaxed to; sweeps of all expansions together.
struct Step {
  double scale = 1; ///< sigma of the last expansion; 1 in the probe
  Vector predicted, V0;
  Network network;
  Relaxation relaxation;
  Refinement refinement = {}; ///< of all expansions; the residual is the last one's
};

/// A formulation of the time step (docs/method/theory.md, section 4).
struct Formulation {
  std::string_view name; ///< in scene files
  bool looks_back;       ///< previous_position and previous_velocity are kept for it
  /// What a step minimises, trying scales until one fits; null in the probe.
  Increment (*increment)(const scene::Mesh& mesh, const StepParameters& motion, const State& state);
  /// V0 of a step's first expansion.
  Vector (*start)(const scene::Mesh& mesh, const State& state, double scale);
  /// What a step from this state relaxes about V0.
  Network (*network)(const scene::Mesh& mesh, const StepParameters& motion, const State& state, double scale,
                     const Vector& V0);
  /// A step, but for the state's V and count of steps.
  Step (*advance)(const scene::Mesh& mesh, const StepParameters& motion, const Order& order, State& state);
};

inline constexpr const Formulation* formulations[] = {&probe, &backward_euler, &bdf2, &statics};

/// A whole step of docs/method/theory.md, section 4.
Step advance(const scene::Mesh& mesh, const StepParameters& motion, const Order& order, State& state);

} // namespace hopmesh::reference
