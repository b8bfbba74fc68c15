/* The probe in whole numbers (docs/method/theory.md, section 4). */
#include "firmware/fixed/fixed_parts.h"

enum { UNIT = 1 << HM_FIXED_OUTPUT };

/* v over its length, Q29; straight down, or nothing, where it has none. */
static void set_direction(const int32_t* v, int32_t* along, int32_t otherwise) {
  const uint64_t square = hm_square_of(v);
  if (square == 0) {
    along[0] = along[1] = 0, along[2] = otherwise;
    return;
  }
  const hm_root root = hm_root_of(square);
  for (uint32_t p = 0; p < 3; ++p) along[p] = hm_along(&root, v[p]);
}

/* V0: the rest state before, scaled to unit length. */
static void set_expansion_point(const hm_fixed_plan* plan, hm_fixed_state* state) {
  static const int32_t nowhere[3] = {0, 0, 0};
  for (uint32_t c = 0; c < plan->cells; ++c)
    set_direction(state->step == 0 ? nowhere : state->output + 3 * c, state->start + 3 * c, -UNIT);
}

/* C = x + v dt; pinned nodes have no way to go. */
static void predict(const hm_fixed_plan* plan, hm_fixed_state* state) {
  for (uint32_t k = 0; k < 3 * plan->nodes; ++k)
    state->predicted[k] = state->position[k] + hm_rounded_down(state->way[k], HM_FIXED_FINER);
}

/* Length of a spring in its places; 0 in `fits` where it is too long for them. */
static inline int32_t length_of(const int32_t d[3], int32_t longest, int* fits) {
  for (uint32_t p = 0; p < 3; ++p)
    if (d[p] > longest || d[p] < -longest) *fits = 0;
  const uint64_t square = hm_square_of(d);
  if (square == 0 || !*fits) return 0;
  const hm_root root = hm_root_of(square);
  return (int32_t)hm_length_of(&root);
}

/* alpha ((l' - L)^2 - (l - L)^2) in places of an energy. */
static inline int64_t energy_between(const hm_fixed_spring* spring, int32_t after, int32_t before,
                                     uint32_t places) {
  const int64_t product = (int64_t)(after - before) * (after + before - 2 * spring->rest);
  const int64_t energy = hm_shifted(product, places);
  return spring->energy == 1 << 17 ? energy : energy * spring->energy >> 17;
}

/* What an end of a spring holds more with its node probed than the spring does at x. */
static inline void probe_end(const hm_fixed_spring* spring, int end, const int32_t apart[3], int32_t before,
                             int32_t longest, const hm_fixed_reach* reach, uint32_t places,
                             hm_fixed_state* state, int* fits) {
  const uint32_t cell = spring->end[end].cell;
  if (cell == HM_PINNED) return;
  const int32_t* direction = state->direction + 3 * cell;
  int32_t probed[3];
  for (uint32_t p = 0; p < 3; ++p) {
    const int32_t way = hm_fixed_reached(reach, direction[p]);
    probed[p] = apart[p] + (end == 0 ? way : -way);
  }
  state->energy[cell] += energy_between(spring, length_of(probed, longest, fits), before, places);
}

static inline void spring_between(const int32_t* at, const hm_fixed_spring* spring, uint32_t up,
                                  int32_t d[3]) {
  const int32_t *a = at + 3 * spring->end[0].node, *b = at + 3 * spring->end[1].node;
  for (uint32_t p = 0; p < 3; ++p) d[p] = (int32_t)((uint32_t)(a[p] - b[p]) << up);
}

/* Delta E of every cell (paper eq. 6), of the node's own springs. That no spring is too long at C, the
   network's making has seen; at x, the step before. */
static int probe_energies(const hm_fixed_work* work, uint32_t* lost_node) {
  const hm_fixed_plan* plan = work->plan;
  hm_fixed_state* state = work->state;
  const uint32_t up = (uint32_t)(plan->spring_places - plan->position_places);
  const uint32_t places = (uint32_t)(2 * plan->spring_places - HM_FIXED_ENERGY);
  const int32_t longest = (plan->longest << up) + (plan->longest << up) / 2;
  const hm_fixed_reach reach = hm_fixed_reach_of(plan, 0);
  int fits = 1;
  for (uint32_t c = 0; c < plan->cells; ++c) state->energy[c] = 0;
  for (const hm_fixed_spring *s = work->mesh->spring, *const end = s + plan->springs; s != end; ++s) {
    int32_t d[3];
    if (s->end[0].cell == HM_PINNED && s->end[1].cell == HM_PINNED) continue;
    spring_between(state->position, s, up, d);
    const int32_t before = length_of(d, longest, &fits);
    spring_between(state->predicted, s, up, d);
    probe_end(s, 0, d, before, longest, &reach, places, state, &fits);
    probe_end(s, 1, d, before, longest, &reach, places, state, &fits);
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
      const int32_t pushed = (int32_t)((int64_t)state->direction[3 * c + p] * kick >> HM_FIXED_OUTPUT);
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
    set_direction(state->output + 3 * c, state->direction + 3 * c, 0);
  TRY(probe_energies(work, lost_node));
  TRY(find_next(work, lost_node));
  return hm_fixed_move(work, lost_node);
}
