// What make_method chooses from; nobody outside this room needs it.
#pragma once

#include "sim/rivals/integrator.h"

namespace hopmesh::rivals {

std::unique_ptr<Method> symplectic_euler(const Physics& physics, double time_step, const Options& options);
std::unique_ptr<Method> velocity_verlet(const Physics& physics, double time_step, const Options& options);
std::unique_ptr<Method> rk4(const Physics& physics, double time_step, const Options& options);
std::unique_ptr<Method> backward_euler(const Physics& physics, double time_step, const Options& options);
std::unique_ptr<Method> bdf2(const Physics& physics, double time_step, const Options& options);
std::unique_ptr<Method> linearly_implicit(const Physics& physics, double time_step, const Options& options);
std::unique_ptr<Method> xpbd(const Physics& physics, double time_step, const Options& options);
std::unique_ptr<Method> projective_dynamics(const Physics& physics, double time_step, const Options& options);

} // namespace hopmesh::rivals
