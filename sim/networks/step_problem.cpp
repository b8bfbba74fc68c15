#include "sim/networks/step_problem.h"

#include "sim/levels/reference_check.h"

namespace hopmesh::networks {

solvers::Problem step_problem(const levels::ReferenceMover& motion, const levels::StepState& before,
                              const levels::Prepared& p, const StepStart& how) {
  levels::StepNetwork n = levels::step_network(motion, before, p, how);
  std::vector<std::uint32_t> component(static_cast<std::size_t>(n.start.size()));
  for (std::size_t i = 0; i < component.size(); ++i) component[i] = i % p.mesh->components();
  return {n.W, std::move(n.I), std::move(n.start), levels::order_for(*p.mesh, spec::Schedule::coloured),
          component};
}

} // namespace hopmesh::networks
