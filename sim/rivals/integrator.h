// The rivals: other methods that walk a scene through time, behind one small interface.
#pragma once

#include "sim/rivals/physics.h"

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace hopmesh::rivals {

struct Options {
  double tolerance = 0; ///< implicit methods: done with the iteration that moves no coordinate by more, m;
                        ///< 0: the method's own, 1e-9, or none where it iterates a fixed number of times
  int max_iterations = 1000; ///< Newton: a step that needs more has failed; one that buckles takes hundreds
  int substeps = 1;          ///< xpbd: equal parts of a time step
  int iterations = 0; ///< xpbd, projective_dynamics: sweeps a (sub)step; 0: the method's own, 1, and 20
                      ///< without a tolerance

  double tolerance_or(double own) const { return tolerance > 0 ? tolerance : own; }
};

/// Work since the start. An iteration is one of Newton's or of conjugate gradients, a sweep of XPBD, a local
/// and a global solve of projective dynamics.
struct Counters {
  std::uint64_t steps = 0, force_passes = 0, factorisations = 0, linear_solves = 0, iterations = 0;
};

/// A method that lost the motion, told in one sentence; its state is then good for nothing.
class LostMotion : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Method {
 public:
  virtual ~Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;

  void advance(); ///< one time step; throws LostMotion
  virtual void start_from(const State& state);
  /// The state a step before, for methods that look back two, once they have done one; else null.
  const State* before() const { return before_ ? &*before_ : nullptr; }
  /// Goes on from where another of this method was, bit for bit; `before`: as it said.
  void go_on_from(const State& now, const State* before);

  const State& state() const { return state_; }
  Vector positions() const { return by_node(state_.position); }  ///< [3 * nodes] node by node, m
  Vector velocities() const { return by_node(state_.velocity); } ///< [3 * nodes] node by node, m/s
  double time_step() const { return time_step_; }
  double time() const { return static_cast<double>(counters_.steps) * time_step_; }
  const Counters& counters() const { return counters_; }
  const std::string& name() const { return name_; }

 protected:
  /// The physics must outlive the method.
  Method(std::string name, const Physics& physics, double time_step)
      : physics_(physics), time_step_(time_step), state_(physics.initial_state()), name_(std::move(name)) {}
  virtual void step() = 0;
  [[noreturn]] void diverge(const std::string& how) const;

  const Physics& physics_;
  const double time_step_;
  State state_;
  std::optional<State> before_; ///< kept by methods that look back
  Counters counters_;

 private:
  std::string name_;
};

const std::vector<std::string>& names();
/// An integrator for people, in a phrase.
const char* about(const std::string& name);

/// Throws std::invalid_argument for a name that is none of names(), a time step that is not positive, options
/// out of range.
std::unique_ptr<Method> make_method(const std::string& name, const Physics& physics, double time_step,
                                    const Options& options = {});

} // namespace hopmesh::rivals
