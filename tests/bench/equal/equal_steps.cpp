#include "tests/bench/equal/equal_steps.h"

#include "sim/levels/array_mover.h"
#include "sim/levels/eigen_vectors.h"
#include "sim/levels/exact_step.h"
#include "sim/levels/level.h"
#include "sim/levels/processor_time.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::bench {
namespace {

using levels::StepState;
using levels::vector_of;
using rivals::Vector;

rivals::State state_of(const std::vector<double>& position, const std::vector<double>& velocity) {
  return {rivals::by_component(vector_of(position)), rivals::by_component(vector_of(velocity))};
}

/// Mean square distance of nodes.
double square(const Vector& a, const Vector& b) {
  return (a - b).squaredNorm() / static_cast<double>(a.size() / 3);
}

/// What integrators know of an array's state. Of nodes that never move the firmware keeps no past, so the
/// past is taken from the state before, where there is one.
StepState motion_of(StepState state, const StepState* before) {
  state.output.clear();
  state.acceleration.clear();
  const bool looks_back = before && !state.previous_position.empty();
  state.previous_position = looks_back ? before->position : std::vector<double>();
  state.previous_velocity = looks_back ? before->velocity : std::vector<double>();
  return state;
}

/// An array under way, its times summed up.
class Timed {
 public:
  explicit Timed(const levels::Prepared& prepared)
      : hertz_(prepared.inputs.array.clock_mhz * 1e6),
        ready_(levels::make_ready(levels::default_level(), prepared)) {}

  const levels::Mover& mover() const { return *ready_.mover; }
  void advance() {
    const double began = levels::processor_seconds();
    const levels::StepRow row = ready_.mover->advance();
    sum_.emulation += levels::processor_seconds() - began;
    sum_.array += static_cast<double>(row.cycles) / hertz_;
    sum_.bus += static_cast<double>(row.bus_cycles) / hertz_;
    sum_.sweeps += static_cast<double>(row.sweeps);
    ++steps_;
  }
  ArrayTime a_step() const {
    return {sum_.array / steps_, sum_.bus / steps_, sum_.emulation / steps_, sum_.sweeps / steps_};
  }

 private:
  const double hertz_;
  levels::ReadyLevel ready_;
  ArrayTime sum_;
  double steps_ = 0;
};

std::size_t steps_of(const levels::Prepared& prepared, std::size_t most) {
  return std::min(most, static_cast<std::size_t>(prepared.inputs.scene.motion.steps));
}

} // namespace

ArrayTime array_time(const std::string& scene, const std::vector<std::string>& overrides,
                     std::size_t most_steps) {
  const levels::Prepared prepared = levels::prepare(scene, "", overrides);
  Timed array(prepared);
  for (std::size_t left = steps_of(prepared, most_steps); left > 0; --left) array.advance();
  return array.a_step();
}

EqualSteps::EqualSteps(const std::string& scene, const std::vector<std::string>& overrides,
                       std::size_t most_steps)
    : prepared_(levels::prepare(scene, "", overrides)),
      physics_(prepared_.mesh->mesh(), levels::surroundings_of(prepared_.inputs.scene)) {
  Timed array(prepared_);
  levels::ExactStep exact(prepared_.inputs.scene, *prepared_.mesh);
  double squares = 0;
  StepState before;
  for (std::size_t left = steps_of(prepared_, most_steps); left > 0; --left) {
    const StepState start = array.mover().state();
    exact.restore(motion_of(start, starts_.empty() ? nullptr : &before), {});
    starts_.push_back(state_of(start.position, start.velocity));
    before = start;
    exact.advance();
    ends_.push_back(vector_of(exact.positions()));
    array.advance();
    squares += square(vector_of(array.mover().positions()), ends_.back());
  }
  array_ = array.a_step();
  array_error_ = std::sqrt(squares / static_cast<double>(count()));
}

std::unique_ptr<rivals::Method> EqualSteps::make(const std::string& method, double tolerance) const {
  rivals::Options options;
  options.tolerance = tolerance;
  return rivals::make_method(method, physics_, prepared_.inputs.scene.motion.time_step, options);
}

void EqualSteps::place(rivals::Method& method, std::size_t step) const {
  method.go_on_from(starts_[step], step > 0 ? &starts_[step - 1] : nullptr);
}

double EqualSteps::error(const std::string& method, double tolerance) const {
  const auto rival = make(method, tolerance);
  double squares = 0;
  for (std::size_t k = 0; k < count(); ++k) {
    place(*rival, k);
    rival->advance();
    squares += square(rival->positions(), ends_[k]);
  }
  return std::sqrt(squares / static_cast<double>(count()));
}

// From above, by powers of ten: what is far narrower than is asked for takes for ever. A method whose error
// falls no more has come to the end of what it linearises.
double EqualSteps::equal_tolerance(const std::string& method) const {
  constexpr double narrowest = -12, falls = 0.99;
  const auto error_at = [&](double power) { return error(method, std::pow(10, power)); };
  double narrow = 0, before = HUGE_VAL;
  for (double now = error_at(narrow); now > array_error_; now = error_at(narrow)) {
    if (narrow <= narrowest || (now < 0.1 * error_at(0) && now > falls * before)) return 0;
    before = now;
    narrow -= 1;
  }
  if (narrow == 0) return 1; // an iteration that moves by less is the first one
  double wide = narrow + 1;
  while (wide - narrow > 1e-3) {
    const double middle = (narrow + wide) / 2;
    (error_at(middle) <= array_error_ ? narrow : wide) = middle;
  }
  return std::pow(10, narrow);
}

} // namespace hopmesh::bench
