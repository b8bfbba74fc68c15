#include "sim/study/twin.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::study {

namespace {

/// Of the largest coordinate. The last place of each coordinate itself would leave those that are 0 where
/// they are, and a flat mesh flat.
double last_place(const scene::Mesh& mesh) {
  double extent = 0;
  for (const scene::Vector3& place : mesh.position)
    for (const double x : place) extent = std::max(extent, std::fabs(x));
  for (const scene::Spring& spring : mesh.springs) extent = std::max(extent, spring.rest_length);
  return std::nextafter(extent, HUGE_VAL) - extent;
}

/// Up or down, in an order that no wave of the mesh has (SplitMix64); the same on every machine.
bool goes_up(std::uint64_t place) {
  std::uint64_t bits = (place + 1) * 0x9e3779b97f4a7c15u;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return ((bits ^ (bits >> 31)) & 1) != 0;
}

// What never moves is not moved here: pinned nodes, and y of planar meshes.
levels::StepState nudged(levels::StepState state, const levels::BuiltMesh& mesh) {
  const double by = last_place(mesh.mesh());
  const bool planar = mesh.components() == 2;
  for (std::size_t k = 0; k < state.position.size(); ++k)
    if (!mesh.mesh().pinned[k / 3] && !(planar && k % 3 == 1)) state.position[k] += goes_up(k) ? by : -by;
  return state;
}

} // namespace

Twin::Twin(const scene::Scene& scene, const levels::BuiltMesh& mesh, const spec::ArraySpec& array)
    : twin_(scene, mesh, array) {
  twin_.restore(nudged(twin_.state(), mesh), {});
}

void Twin::step(const levels::StepRow&, const levels::Mover& reference) {
  double apart = HUGE_VAL;
  if (apart_.empty() || std::isfinite(apart_.back())) {
    try {
      twin_.advance();
      apart = run::rms_distance(reference.positions(), twin_.positions());
    } catch (const levels::LostMotion&) {
    }
  }
  apart_.push_back(apart);
}

std::optional<double> Twin::apart_at(double time, double time_step) const {
  const std::uint64_t step = run::step_of_time(time, time_step);
  if (step < 1 || step > apart_.size() || !std::isfinite(apart_[step - 1])) return std::nullopt;
  return apart_[step - 1];
}

std::vector<std::optional<double>> sensitivity_of(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                                                  const std::vector<double>& times,
                                                  const std::atomic<bool>& stop) {
  const scene::MotionKeys& motion = inputs.scene.motion;
  levels::ReferenceMover reference(inputs.scene, mesh, inputs.array);
  Twin twin(inputs.scene, mesh, inputs.array);
  run::simulate(reference, static_cast<std::uint64_t>(motion.steps), {&twin}, stop);
  std::vector<std::optional<double>> at(times.size());
  for (std::size_t k = 0; k < times.size(); ++k) at[k] = twin.apart_at(times[k], motion.time_step);
  return at;
}

} // namespace hopmesh::study
