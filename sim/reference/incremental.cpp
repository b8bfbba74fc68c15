// One time step of the incremental potential (docs/theory.md, section 4): backward Euler and BDF2 as the
// minimum of inertia and springs, relaxed by the network at a scale that suits its outputs.
#include "sim/reference/assembly.h"

#include <cmath>

namespace hopmesh::reference {
namespace {

constexpr double highest_peak = 0.75, lowest_peak = 0.125; // of |V| at rest, else another scale is tried
constexpr int smallest_exponent = -200;
constexpr int most_growths = 64;

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

// Force of the springs on every free node at C, as the change of acceleration that alone it would give;
// before the first step nothing better is known. 1/2 where nothing pulls: any scale will do.
double first_change(const scene::Mesh& mesh, const Increment& increment) {
  Vector pull = Vector::Zero(3 * nodes_of(mesh));
  for (const scene::Spring& spring : mesh.springs) {
    const auto [i, j] = spring.node;
    const Vector3 u = at(increment.predicted, i) - at(increment.predicted, j);
    const Vector3 f = expand_spring(spring, 1, u, Compressed::as_none).slope;
    at(pull, i) -= f;
    at(pull, j) += f;
  }
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) {
    if (mesh.pinned[node]) at(pull, node).setZero();
    if (mesh.planar) pull[3 * node + 1] = 0;
  }
  const double largest = largest_in(pull);
  return largest > 0 ? largest / (increment.inertia * increment.h) : 0.5;
}

double first_scale(const scene::Mesh& mesh, const Increment& increment, const State& state) {
  const double before = largest_in(state.acceleration);
  return scale_for(before > 0 ? before : first_change(mesh, increment));
}

/// A step while it looks for its scale.
class Relaxing {
 public:
  Relaxing(const scene::Mesh& mesh, const Motion& motion, const Order& order, const Increment& increment)
      : mesh_(mesh), motion_(motion), order_(order), increment_(increment) {}

  // Grows the scale as often as it must, shrinks it once.
  void relax_in_range(Step& step) {
    bool shrunk = false;
    for (int growths = 0;;) {
      relax_once(step);
      const double largest = largest_in(step.relaxation.V);
      double wanted = step.scale;
      if (largest > highest_peak && growths++ < most_growths)
        wanted = 2 * step.scale;
      else if (largest > 0 && largest < lowest_peak && !shrunk) {
        wanted = std::min(step.scale, scale_for(largest * step.scale));
        shrunk = true;
      }
      if (wanted == step.scale) return;
      step.relaxation.V *= step.scale / wanted;
      step.scale = wanted;
    }
  }

 private:
  void relax_once(Step& step) const {
    const std::uint32_t before = step.relaxation.sweeps;
    step.V0 = step.relaxation.V;
    step.network = network(mesh_, increment_, step.scale, step.V0);
    step.relaxation =
        relax(step.network, order_, step.V0, motion_.threshold, motion_.max_sweeps, motion_.output);
    step.relaxation.sweeps += before;
  }

  const scene::Mesh& mesh_;
  const Motion& motion_;
  const Order& order_;
  const Increment& increment_;
};

bool two_steps(const Motion& motion, const State& state) {
  return motion.rule == Rule::bdf2 && state.step > 0;
}

// BDF2's v is the derivative of the parabola through three positions.
void move(const scene::Mesh& mesh, const Motion& motion, const Increment& increment, const Vector& change,
          State& state) {
  const Vector x = state.position, v = state.velocity;
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) {
    if (mesh.pinned[node]) continue;
    const Vector3 next = at(increment.predicted, node) + increment.h * at(change, node);
    const Vector3 slope = two_steps(motion, state)
                              ? Vector3(3 * next - 4 * at(x, node) + at(state.previous_position, node)) / 2
                              : Vector3(next - at(x, node));
    at(state.velocity, node) = slope / motion.time_step * motion.friction;
    at(state.position, node) = next;
  }
  state.acceleration = change;
  if (motion.rule == Rule::bdf2) state.previous_position = x, state.previous_velocity = v;
}

} // namespace

Increment increment(const scene::Mesh& mesh, const Motion& motion, const State& state) {
  const bool two = two_steps(motion, state);
  const double tau = two ? motion.time_step * 2 / 3 : motion.time_step, slowed = 1 + motion.drag * tau;
  Increment result{state.position, tau * tau / 2, motion.mass * slowed / (tau * tau)};
  Vector3 force = motion.force;
  if (mesh.planar) force.y() = 0;
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) {
    if (mesh.pinned[node]) continue;
    Vector3 x = at(state.position, node), v = at(state.velocity, node);
    if (two) {
      x = (4 * x - at(state.previous_position, node)) / 3;
      v = (4 * v - at(state.previous_velocity, node)) / 3;
    }
    at(result.predicted, node) = x + tau / slowed * (v + tau * force);
  }
  return result;
}

double energy(const scene::Mesh& mesh, const Increment& increment, double scale, const Vector& V) {
  const double reach = increment.h * scale;
  Vector place = increment.predicted;
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) at(place, node) += reach * output(mesh, V, node);
  return spring_energy(mesh, place) + increment.inertia / 2 * (place - increment.predicted).squaredNorm();
}

Network network(const scene::Mesh& mesh, const Increment& increment, double scale, const Vector& V0) {
  const double reach = increment.h * scale, inertia = increment.inertia * reach * reach;
  Assembly assembly(mesh);
  for (const scene::Spring& spring : mesh.springs) {
    const auto [i, j] = spring.node;
    const Vector3 u = at(increment.predicted, i) - at(increment.predicted, j) +
                      reach * (output(mesh, V0, i) - output(mesh, V0, j));
    assembly.add_spring(spring, expand_spring(spring, reach, u, Compressed::as_none));
  }
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node)
    assembly.add_node(node, {inertia * Block::Identity(), inertia * output(mesh, V0, node)});
  return assembly.network(V0);
}

Vector expansion_point(const scene::Mesh& mesh, const State& state, double scale) {
  Vector V0 = Vector::Zero(components(mesh) * nodes_of(mesh));
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node)
    if (!mesh.pinned[node]) set_output(mesh, V0, node, at(state.acceleration, node) / scale);
  return V0;
}

Step advance_incremental(const scene::Mesh& mesh, const Motion& motion, const Order& order, State& state) {
  const Increment about = increment(mesh, motion, state);
  Step step;
  step.predicted = about.predicted;
  step.scale = first_scale(mesh, about, state);
  step.relaxation.V = expansion_point(mesh, state, step.scale);
  Relaxing relaxing(mesh, motion, order, about);
  for (std::uint32_t expansion = 0; expansion < motion.expansions; ++expansion) relaxing.relax_in_range(step);
  Vector change = Vector::Zero(3 * nodes_of(mesh));
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node)
    at(change, node) = step.scale * output(mesh, step.relaxation.V, node);
  move(mesh, motion, about, change, state);
  return step;
}

} // namespace hopmesh::reference
