#include "firmware/relax.h"

#include "firmware/bus.h"

void hm_add_relaxation(hm_relaxation* sum, const hm_relaxation* one) {
  sum->sweeps += one->sweeps;
  sum->cycles += one->cycles;
  sum->converged = one->converged;
}

int hm_relax(const hm_solver* solver, const hm_mesh* mesh, hm_network* network, double* start,
             double threshold, uint32_t max_sweeps, hm_relaxation* sum) {
  const uint32_t neurons = hm_neuron_count(mesh);
  for (uint32_t k = 0; k < neurons; ++k) start[k] = network->output[k];
  hm_relaxation one;
  const int error = solver->relax(solver->context, mesh, network, threshold, max_sweeps, &one);
  if (error == HM_OK) hm_add_relaxation(sum, &one);
  return error;
}
