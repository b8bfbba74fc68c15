// A time step of the incremental potential (docs/method/theory.md, section 4): backward Euler and BDF2 as
// the minimum of inertia and springs, relaxed by the network at a scale that suits its outputs; the static
// step as the minimum of springs and load alone.
#include "sim/reference/assembly.h"

#include <cmath>

namespace hopmesh::reference {
namespace {

constexpr double highest_peak = 0.75, lowest_peak = 0.125; // of |V| at rest, else another scale is tried
constexpr int smallest_exponent = -200;
constexpr int most_growths = 64;
constexpr int most_halvings = 40;
constexpr double rounding = 1e-12; // of an energy's terms

double largest_in(const Vector& values) {
  return values.size() == 0 ? 0 : values.cwiseAbs().maxCoeff();
}

// The scale at which `change` would be an output of 1/4 to 1/2 (1/2 at a power of two).
double scale_for(double change) {
  int exponent;
  const double mantissa = std::frexp(2 * change, &exponent);
  if (mantissa == 0.5) --exponent;
  return std::ldexp(1.0, std::max(exponent, smallest_exponent));
}

bool is_static(const Increment& increment) {
  return increment.load.size() > 0;
}

// Force of springs and load on every free node at C.
Vector pull_at(const scene::Mesh& mesh, const Increment& increment) {
  Vector pull = is_static(increment) ? increment.load : Vector::Zero(3 * nodes_of(mesh));
  for (const scene::Spring& spring : mesh.springs) {
    const auto [i, j] = spring.node;
    const Vector3 u = at(increment.predicted, i) - at(increment.predicted, j);
    const Vector3 f = expand_spring(mesh, spring, 1, u, Compressed::as_none).slope;
    at(pull, i) -= f;
    at(pull, j) += f;
  }
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) {
    if (mesh.pinned[node]) at(pull, node).setZero();
    if (mesh.planar) pull[3 * node + 1] = 0;
  }
  return pull;
}

// What the pull alone would do to the stiffest node, held by its own weight and no neighbour: nothing better
// is known before the first step, and an output there moves at least half as far as this. 1/2 where nothing
// pulls: any scale will do.
double change_by_pull(const scene::Mesh& mesh, const Increment& increment) {
  const double largest = largest_in(pull_at(mesh, increment));
  if (largest == 0) return 0.5;
  const Vector still = Vector::Zero(components(mesh) * nodes_of(mesh));
  return largest * increment.h / largest_in(network(mesh, increment, 1, still).W.diagonal());
}

// Where the energy is a quadratic form its minimum is trusted however far it is; elsewhere a step goes no
// further than the longest spring.
double trusted(const scene::Mesh& mesh, const Increment& increment) {
  double longest = 0;
  bool quadratic = mesh.law == scene::SpringLaw::linear;
  for (const scene::Spring& spring : mesh.springs) {
    const Vector3 u = at(increment.predicted, spring.node[0]) - at(increment.predicted, spring.node[1]);
    longest = std::max(longest, u.norm());
    quadratic = quadratic && spring.rest_length == 0;
  }
  return quadratic || !is_static(increment) ? HUGE_VAL : longest;
}

double first_scale(const scene::Mesh& mesh, const Increment& increment, const State& state) {
  const double before = is_static(increment) ? 0 : largest_in(state.acceleration);
  const double change = before > 0 ? before : change_by_pull(mesh, increment);
  return scale_for(std::min(change, trusted(mesh, increment) / 2));
}

/// A step while it looks for its scale.
class Relaxing {
 public:
  Relaxing(const scene::Mesh& mesh, const StepParameters& motion, const Order& order,
           const Increment& increment, std::uint64_t number)
      : mesh_(mesh), motion_(motion), order_(order), increment_(increment), number_(number),
        trusted_(trusted(mesh, increment)),
        finest_(std::ldexp(largest_in(increment.predicted) / increment.h, -53)) {}

  // Down while the outputs are small, then up while they are large: never down again, or it might go on for
  // ever.
  void relax_in_range(Step& step) {
    relax_once(step);
    while (rescale(step, smaller(step))) relax_once(step);
    for (int k = 0; k < most_growths && rescale(step, larger(step)); ++k) relax_once(step);
    if (motion_.refinements > 0 && !motion_.answer) correct(step);
  }

 private:
  void relax_once(Step& step) const {
    const std::uint32_t before = step.relaxation.sweeps;
    step.V0 = step.relaxation.V;
    step.network = network(mesh_, increment_, step.scale, step.V0);
    step.relaxation = answered(motion_, step.network, order_, step.V0, number_);
    step.relaxation.sweeps += before;
  }

  void correct(Step& step) const {
    const Refinement made = refine(step.network, order_, step.V0, motion_.stop(), motion_.rule,
                                   motion_.refinements, step.relaxation);
    step.refinement.corrections += made.corrections;
    step.refinement.refused += made.refused;
    step.refinement.residual = made.residual;
  }

  // Words may be too coarse for anything to move at a scale; where nothing pulls, nothing should. A scale is
  // fine enough where an output of 1 moves nobody by as much as doubles can tell.
  double smaller(const Step& step) const {
    const double largest = largest_in(step.relaxation.V);
    if (!(largest < lowest_peak)) return step.scale;
    double wanted = largest > 0 ? scale_for(largest * step.scale) : step.scale / 4;
    if (largest == 0 && !(largest_in(step.network.I) > 0)) wanted = step.scale;
    return wanted >= finest_ ? std::min(wanted, step.scale) : step.scale;
  }

  double larger(const Step& step) const {
    const bool grows = largest_in(step.relaxation.V) > highest_peak && 2 * step.scale <= trusted_;
    return grows ? 2 * step.scale : step.scale;
  }

  static bool rescale(Step& step, double scale) {
    if (scale == step.scale) return false;
    step.relaxation.V *= step.scale / scale;
    step.scale = scale;
    return true;
  }

  const scene::Mesh& mesh_;
  const StepParameters& motion_;
  const Order& order_;
  const Increment& increment_;
  const std::uint64_t number_;
  const double trusted_, finest_;
};

// Springs and inertia less the work of the load, with `change` added to C; `size`: of its terms.
double potential(const scene::Mesh& mesh, const Increment& increment, const Vector& change, double& size) {
  const Vector moved = increment.h * change, place = increment.predicted + moved;
  const double springs = spring_energy(mesh, place), held = increment.inertia / 2 * moved.squaredNorm();
  size = std::abs(springs) + held;
  if (!is_static(increment)) return springs + held;
  size += increment.load.cwiseProduct(place).cwiseAbs().sum();
  return springs - increment.load.dot(place);
}

// An expansion says which way is down, not for how far: half the way, and half of that, until none is up. An
// implicit step that never comes below C stays there, and the next one expands about that place.
void stay_below(const scene::Mesh& mesh, const Increment& increment, Vector& change) {
  double size;
  const double start = potential(mesh, increment, Vector::Zero(change.size()), size);
  for (int k = 0; k < most_halvings; ++k, change /= 2)
    if (potential(mesh, increment, change, size) - start <= rounding * size) return;
  if (!is_static(increment)) change.setZero();
}

// BDF2's v is the derivative of the parabola through three positions.
void move(const scene::Mesh& mesh, const StepParameters& motion, const Increment& increment,
          const Vector& change, State& state) {
  const Vector x = state.position, v = state.velocity;
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) {
    if (mesh.pinned[node]) continue;
    const Vector3 next = at(increment.predicted, node) + increment.h * at(change, node);
    const Vector3 slope = increment.two_steps
                              ? Vector3(3 * next - 4 * at(x, node) + at(state.previous_position, node)) / 2
                              : Vector3(next - at(x, node));
    at(state.velocity, node) =
        is_static(increment) ? Vector3::Zero() : Vector3(slope / motion.time_step * motion.friction);
    at(state.position, node) = next;
  }
  state.acceleration = change;
  if (motion.formulation->looks_back) state.previous_position = x, state.previous_velocity = v;
}

// Acceleration of a free node by what is no spring.
Vector3 force_on(const scene::Mesh& mesh, const StepParameters& motion, Eigen::Index node) {
  Vector3 force = motion.force;
  if (motion.node_force.size() > 0) force += at(motion.node_force, node);
  if (mesh.planar) force.y() = 0;
  return force;
}

// Backward Euler's; with `two_steps` BDF2's.
Increment implicit_increment(const scene::Mesh& mesh, const StepParameters& motion, const State& state,
                             bool two_steps) {
  const double tau = two_steps ? motion.time_step * 2 / 3 : motion.time_step, slowed = 1 + motion.drag * tau;
  Increment result{state.position, tau * tau / 2, motion.mass * slowed / (tau * tau), {}, two_steps};
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) {
    if (mesh.pinned[node]) continue;
    Vector3 x = at(state.position, node), v = at(state.velocity, node);
    if (two_steps) {
      x = (4 * x - at(state.previous_position, node)) / 3;
      v = (4 * v - at(state.previous_velocity, node)) / 3;
    }
    at(result.predicted, node) = x + tau / slowed * (v + tau * force_on(mesh, motion, node));
  }
  return result;
}

Increment backward_euler_increment(const scene::Mesh& mesh, const StepParameters& motion,
                                   const State& state) {
  return implicit_increment(mesh, motion, state, false);
}

Increment bdf2_increment(const scene::Mesh& mesh, const StepParameters& motion, const State& state) {
  return implicit_increment(mesh, motion, state, state.step > 0);
}

Increment static_increment(const scene::Mesh& mesh, const StepParameters& motion, const State& state) {
  Increment result{state.position, 1, 0, Vector::Zero(3 * nodes_of(mesh))};
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node)
    if (!mesh.pinned[node]) at(result.load, node) = motion.mass * force_on(mesh, motion, node);
  return result;
}

} // namespace

Increment increment(const scene::Mesh& mesh, const StepParameters& motion, const State& state) {
  return motion.formulation->increment(mesh, motion, state);
}

double energy(const scene::Mesh& mesh, const Increment& increment, double scale, const Vector& V) {
  const double reach = increment.h * scale;
  Vector place = increment.predicted;
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) at(place, node) += reach * output(mesh, V, node);
  const double springs =
      spring_energy(mesh, place) + increment.inertia / 2 * (place - increment.predicted).squaredNorm();
  return is_static(increment) ? springs - increment.load.dot(place) : springs;
}

Network network(const scene::Mesh& mesh, const Increment& increment, double scale, const Vector& V0) {
  const double reach = increment.h * scale, inertia = increment.inertia * reach * reach;
  Assembly assembly(mesh);
  for (const scene::Spring& spring : mesh.springs) {
    const auto [i, j] = spring.node;
    const Vector3 u = at(increment.predicted, i) - at(increment.predicted, j) +
                      reach * (output(mesh, V0, i) - output(mesh, V0, j));
    assembly.add_spring(spring, expand_spring(mesh, spring, reach, u, Compressed::as_none));
  }
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) {
    Vector3 slope = inertia * output(mesh, V0, node);
    if (is_static(increment)) slope -= reach * at(increment.load, node);
    assembly.add_node(node, {inertia * Block::Identity(), slope});
  }
  return assembly.network(V0);
}

Vector expansion_point(const scene::Mesh& mesh, const State& state, double scale) {
  Vector V0 = Vector::Zero(components(mesh) * nodes_of(mesh));
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node)
    if (!mesh.pinned[node]) set_output(mesh, V0, node, at(state.acceleration, node) / scale);
  return V0;
}

namespace {

// A static step starts where it stands.
Vector no_outputs(const scene::Mesh& mesh, const State&, double) {
  return Vector::Zero(components(mesh) * nodes_of(mesh));
}

Network potential_network(const scene::Mesh& mesh, const StepParameters& motion, const State& state,
                          double scale, const Vector& V0) {
  return network(mesh, increment(mesh, motion, state), scale, V0);
}

Step advance_potential(const scene::Mesh& mesh, const StepParameters& motion, const Order& order,
                       State& state) {
  const Increment about = increment(mesh, motion, state);
  Step step;
  step.predicted = about.predicted;
  step.scale = first_scale(mesh, about, state);
  step.relaxation.V = motion.formulation->start(mesh, state, step.scale);
  Relaxing relaxing(mesh, motion, order, about, state.step);
  for (std::uint32_t expansion = 0; expansion < motion.expansions; ++expansion) relaxing.relax_in_range(step);
  Vector change = Vector::Zero(3 * nodes_of(mesh));
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node)
    at(change, node) = step.scale * output(mesh, step.relaxation.V, node);
  if (is_static(about) || mesh.law == scene::SpringLaw::tension) stay_below(mesh, about, change);
  move(mesh, motion, about, change, state);
  return step;
}

} // namespace

const Formulation backward_euler{
    "backward_euler", false, backward_euler_increment, expansion_point, potential_network, advance_potential};
const Formulation bdf2{"bdf2", true, bdf2_increment, expansion_point, potential_network, advance_potential};
const Formulation statics{"static",         false, static_increment, no_outputs, potential_network,
                          advance_potential};

} // namespace hopmesh::reference
