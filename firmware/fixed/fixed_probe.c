/* The probe in whole numbers (docs/method/theory.md, section 4). */
#include "firmware/fixed/fixed_parts.h"

enum { UNIT = 1 << HM_FIXED_OUTPUT };

/* v over its length, Q29; straight down, or nothing, where it has none. */
static void set_direction(hm_triple v, int32_t* along, int32_t otherwise) {
  const uint64_t square = hm_square_of(v);
  if (square == 0) {
    along[0] = along[1] = 0, along[2] = otherwise;
    return;
  }
  const hm_root root = hm_root_of(square);
  along[0] = hm_along(&root, v.x), along[1] = hm_along(&root, v.y), along[2] = hm_along(&root, v.z);
}

/* V0: the rest state before, scaled to unit length. */
static void set_expansion_point(const hm_fixed_plan* plan, hm_fixed_state* state) {
  for (uint32_t c = 0; c < plan->cells; ++c)
    set_direction(state->step == 0 ? (hm_triple){0, 0, 0} : hm_triple_at(state->output + 3 * c),
                  state->start + 3 * c, -UNIT);
}

/* C = x + v dt; pinned nodes have no way to go. */
static void predict(const hm_fixed_plan* plan, hm_fixed_state* state) {
  for (uint32_t k = 0; k < 3 * plan->nodes; ++k)
    state->predicted[k] = state->position[k] + hm_rounded_down(state->way[k], HM_FIXED_FINER);
}

/* What the energies know of the plan. */
typedef struct probing {
  hm_fixed_reach reach;
  uint32_t up, places; /* from positions to springs; from squares of lengths to energies */
  int32_t longest;
} probing;

/* Length of a spring in its places; 0 in `fits` where it is too long for them. */
static inline int32_t length_of(hm_triple d, int32_t longest, int* fits) {
  const uint32_t most = 2 * (uint32_t)longest;
  *fits &= (uint32_t)(d.x + longest) < most && (uint32_t)(d.y + longest) < most &&
           (uint32_t)(d.z + longest) < most;
  const uint64_t square = hm_square_of(d);
  if (square == 0 || !*fits) return 0;
  const hm_root root = hm_root_of(square);
  return (int32_t)hm_length_of(&root);
}

/* alpha ((l' - L)^2 - (l - L)^2) in places of an energy. */
static inline int64_t energy_between(const hm_fixed_spring* spring, int32_t after, int32_t before,
                                     const probing* by) {
  const int64_t product = hm_product(after - before, after + before - 2 * spring->rest);
  const int64_t energy = hm_shifted(product, by->places);
  return spring->energy == 1 << 17 ? energy : hm_shifted(energy * spring->energy, 17);
}

/* What an end of a spring holds more with its node probed than the spring does at x; `sign` is that of the
 * end. */
static inline void probe_end(const hm_fixed_spring* spring, uint32_t cell, hm_triple apart, int32_t sign,
                             int32_t before, const probing* by, hm_fixed_state* state, int* fits) {
  if (cell == HM_PINNED) return;
  const hm_triple to = hm_triple_at(state->direction + 3 * cell);
  const hm_fixed_reach reach = by->reach;
  const hm_triple probed = {apart.x + sign * hm_fixed_reached(&reach, to.x),
                            apart.y + sign * hm_fixed_reached(&reach, to.y),
                            apart.z + sign * hm_fixed_reached(&reach, to.z)};
  state->energy[cell] += energy_between(spring, length_of(probed, by->longest, fits), before, by);
}

static inline hm_triple spring_between(const int32_t* at, const hm_fixed_spring* spring, uint32_t up) {
  const int32_t *a = at + 3 * spring->end[0].node, *b = at + 3 * spring->end[1].node;
  return (hm_triple){(int32_t)(((uint32_t)a[0] - (uint32_t)b[0]) << up),
                     (int32_t)(((uint32_t)a[1] - (uint32_t)b[1]) << up),
                     (int32_t)(((uint32_t)a[2] - (uint32_t)b[2]) << up)};
}

/* Delta E of every cell (paper eq. 6), of the node's own springs. That no spring is too long at C, the
   network's making has seen; at x, the step before. */
static int probe_energies(const hm_fixed_work* work, uint32_t* lost_node) {
  const hm_fixed_plan* plan = work->plan;
  hm_fixed_state* state = work->state;
  const uint32_t up = (uint32_t)(plan->spring_places - plan->position_places);
  const probing by = {hm_fixed_reach_of(plan, 0), up, (uint32_t)(2 * plan->spring_places - HM_FIXED_ENERGY),
                      (plan->longest << up) + (plan->longest << up) / 2};
  int fits = 1;
  for (uint32_t c = 0; c < plan->cells; ++c) state->energy[c] = 0;
  for (const hm_fixed_spring *s = work->mesh->spring, *const end = s + plan->springs; s != end; ++s) {
    if (s->end[0].cell == HM_PINNED && s->end[1].cell == HM_PINNED) continue;
    const int32_t before = length_of(spring_between(state->position, s, up), by.longest, &fits);
    const hm_triple apart = spring_between(state->predicted, s, up);
    probe_end(s, s->end[0].cell, apart, 1, before, &by, state, &fits);
    probe_end(s, s->end[1].cell, apart, -1, before, &by, state, &fits);
    if (!fits) return hm_fixed_lost(s->end[0].node, lost_node);
  }
  return HM_OK;
}

/* sqrt(gamma |Delta E|) dt^2 in places of a way (eq. 7), and 2^30 where that is no less. */
static int32_t kick_of(const hm_fixed_plan* plan, int64_t energy) {
  const uint64_t size = (uint64_t)(energy < 0 ? -energy : energy);
  if (size == 0) return 0;
  if (size >> 62 != 0) return 1 << 30;
  const hm_root root = hm_root_of(size);
  /* sqrt(mantissa / 2^32) in Q30; the root of the energy is 2^(32 - half - 19) times that */
  const uint32_t whole = hm_upper_of(root.mantissa, root.inverse);
  const uint64_t product = (uint64_t)whole * (uint32_t)plan->gain; /* Q61, times 2^gain_exponent */
  const int32_t way_places = plan->position_places + HM_FIXED_FINER;
  const int32_t down =
      61 - way_places - plan->gain_exponent - (32 - HM_FIXED_ENERGY / 2 - (int32_t)root.half);
  if (down > 63) return 0;
  if (down < 0 || hm_shifted((int64_t)product, (uint32_t)down) >= 1 << 30) return 1 << 30;
  return (int32_t)hm_shifted((int64_t)product, (uint32_t)down);
}

/* Position, velocity with friction, then the force. */
static int find_next(const hm_fixed_work* work, uint32_t* lost_node) {
  const hm_fixed_plan* plan = work->plan;
  hm_fixed_state* state = work->state;
  int32_t* next = state->next;
  for (uint32_t c = 0; c < plan->cells; ++c, next += 6) {
    const uint32_t node = work->mesh->node[c].node;
    const int32_t kick = kick_of(plan, state->energy[c]);
    if (kick >= 1 << 30) return hm_fixed_lost(node, lost_node);
    state->kick[c] = kick;
    for (uint32_t p = 0; p < 3; ++p) {
      const int32_t way = state->way[3 * node + p];
      const int32_t pushed = hm_upper(state->direction[3 * c + p] << 2, kick) << 1; /* Q31 */
      next[p] = state->position[3 * node + p] + hm_rounded_down(way + (pushed >> 1), HM_FIXED_FINER);
      next[3 + p] = (int32_t)((int64_t)(way + pushed) * plan->kept >> 30) + plan->fall[p];
    }
  }
  return HM_OK;
}

int hm_fixed_probe(const hm_fixed_work* work, hm_relaxation* sum, uint32_t* lost_node) {
  const hm_fixed_plan* plan = work->plan;
  hm_fixed_state* state = work->state;
  state->scale_exponent = 0;
  predict(plan, state);
  set_expansion_point(plan, state);
  TRY(hm_fixed_build(work, lost_node));
  TRY(hm_fixed_relax(work, sum));
  for (uint32_t c = 0; c < plan->cells; ++c)
    set_direction(hm_triple_at(state->output + 3 * c), state->direction + 3 * c, 0);
  TRY(probe_energies(work, lost_node));
  TRY(find_next(work, lost_node));
  return hm_fixed_move(work, lost_node);
}
