#include "firmware/fixed/fixed_parts.h"

/* What is added to a position in a step, and to a way, still fits. */
static const int32_t most_position = INT32_MAX - (1 << 28), most_way = (1 << 30) - 1;

static int fits(const int32_t* next) {
  for (uint32_t p = 0; p < 3; ++p)
    if (hm_magnitude_of(next[p]) > most_position || hm_magnitude_of(next[3 + p]) > most_way) return 0;
  return 1;
}

int hm_fixed_move(const hm_fixed_work* work, uint32_t* lost_node) {
  const hm_fixed_plan* plan = work->plan;
  hm_fixed_state* state = work->state;
  const int32_t* next = state->next;
  for (uint32_t c = 0; c < plan->cells; ++c, next += 6)
    if (!fits(next)) return hm_fixed_lost(work->mesh->node[c].node, lost_node);
  next = state->next;
  for (uint32_t c = 0; c < plan->cells; ++c, next += 6)
    for (uint32_t p = 0, at = 3 * work->mesh->node[c].node; p < 3; ++p, ++at) {
      state->position[at] = next[p];
      state->way[at] = next[3 + p];
    }
  return HM_OK;
}

int hm_fixed_step(const hm_fixed_work* work, hm_relaxation* sum, uint32_t* lost_node) {
  *sum = (hm_relaxation){0};
  *lost_node = HM_PINNED;
  const int error =
      work->plan->implicit ? hm_fixed_implicit(work, sum, lost_node) : hm_fixed_probe(work, sum, lost_node);
  if (error == HM_OK) work->state->step += 1;
  return error;
}
