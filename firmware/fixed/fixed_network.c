/* Weights and biases in whole numbers: docs/method/theory.md, section 2, with the bias gathered spring by
   spring. I = -W V0 - g is the sum over a node's springs of S (V0_i - V0_j) - f, and what the node's own term
   leaves. */
#include "firmware/fixed/fixed_parts.h"

enum {
  ONE = 1 << 28
}; /* slack is Q28; of a spring below an eighth of its rest length it stays just below 8 */

/* A symmetric block. */
typedef struct block {
  int32_t xx, xy, xz, yy, yz, zz;
} block;

/* What a step knows before its springs. */
typedef struct scales {
  hm_fixed_reach reach;
  uint32_t up;        /* from places of a position to those of a spring */
  uint32_t turn_down; /* from the upper word of weight times output to the bias, ... */
  int32_t turn_up;    /* ... and back, as a factor */
  uint32_t way_down;  /* from a spring's way to the bias: places that are too many */
  int32_t longest;
  int convex;
} scales;

typedef struct ends {
  hm_triple apart; /* V0_i - V0_j, Q29 */
  hm_triple along; /* u over its length, Q29 */
  int32_t stretch; /* length - rest length, in places of a spring */
  int32_t slack;   /* rest length over length, Q28 */
} ends;

hm_fixed_reach hm_fixed_reach_of(const hm_fixed_plan* plan, int32_t scale_exponent) {
  return (hm_fixed_reach){plan->h, (uint32_t)(28 - plan->spring_places - plan->h_exponent - scale_exponent)};
}

static inline int32_t slack_of(const hm_root* root, int32_t rest, int32_t length, int convex) {
  if (convex && rest >= length) return ONE;
  if (rest >> 3 >= length - 1) return INT32_MAX;
  return (int32_t)hm_product_from((uint32_t)rest, root->inverse, 34 - root->half);
}

static inline hm_triple less(hm_triple a, hm_triple b) {
  return (hm_triple){(int32_t)((uint32_t)a.x - (uint32_t)b.x), (int32_t)((uint32_t)a.y - (uint32_t)b.y),
                     (int32_t)((uint32_t)a.z - (uint32_t)b.z)};
}

static inline hm_triple output_of(const hm_fixed_state* state, uint32_t cell) {
  return cell == HM_PINNED ? (hm_triple){0, 0, 0} : hm_triple_at(state->start + 3 * cell);
}

/* Is a component within -longest to longest - 1? */
static inline int is_within(int32_t component, int32_t longest) {
  return (uint32_t)component + (uint32_t)longest < 2 * (uint32_t)longest;
}

/* 0 where the spring is longer than numbers reach. */
static inline int look(const hm_fixed_spring* spring, const hm_fixed_state* state, const scales* by,
                       ends* e) {
  const hm_fixed_end *a = &spring->end[0], *b = &spring->end[1];
  const hm_triple away =
      less(hm_triple_at(state->predicted + 3 * a->node), hm_triple_at(state->predicted + 3 * b->node));
  if (!is_within(away.x, by->longest) || !is_within(away.y, by->longest) || !is_within(away.z, by->longest))
    return 0;
  const hm_triple apart = less(output_of(state, a->cell), output_of(state, b->cell));
  const hm_fixed_reach reach = by->reach;
  const hm_triple u = {(int32_t)((uint32_t)away.x << by->up) + hm_fixed_reached(&reach, apart.x),
                       (int32_t)((uint32_t)away.y << by->up) + hm_fixed_reached(&reach, apart.y),
                       (int32_t)((uint32_t)away.z << by->up) + hm_fixed_reached(&reach, apart.z)};
  const uint64_t square = hm_square_of(u);
  if (square == 0) { /* no direction: the part without a rest length alone */
    *e = (ends){.apart = apart};
    return 1;
  }
  const hm_root root = hm_root_of(square);
  const int32_t length = (int32_t)hm_length_of(&root);
  *e = (ends){.apart = apart,
              .along = {hm_along(&root, u.x), hm_along(&root, u.y), hm_along(&root, u.z)},
              .stretch = length - spring->rest,
              .slack = slack_of(&root, spring->rest, length, by->convex)};
  return 1;
}

/* S = a ((1 - slack) 1 + slack w w), in Q27. */
static inline block stiffness_of(const hm_fixed_spring* spring, const ends* e) {
  const int32_t x = e->along.x << 2, y = e->along.y << 2, z = e->along.z << 2; /* Q31, below 1 */
  const int32_t sx = hm_upper(e->slack, x) << 1, sy = hm_upper(e->slack, y) << 1,
                sz = hm_upper(e->slack, z) << 1; /* Q28 */
  const int32_t round = (ONE - e->slack) >> 1, a = spring->stiffness;
  const block s = {hm_upper(sx, x) + round, hm_upper(sx, y), hm_upper(sx, z),
                   hm_upper(sy, y) + round, hm_upper(sy, z), hm_upper(sz, z) + round};
  if (a == 1 << 30) return s;
  return (block){hm_upper(s.xx, a) << 2, hm_upper(s.xy, a) << 2, hm_upper(s.xz, a) << 2,
                 hm_upper(s.yy, a) << 2, hm_upper(s.yz, a) << 2, hm_upper(s.zz, a) << 2};
}

/* A component of S (V0_i - V0_j) - f. */
static inline int64_t pull_of(int32_t turn, int32_t stretch, int32_t along, int32_t pull, const scales* by) {
  const int32_t way = hm_upper(stretch << 1, along << 2) >> by->way_down;
  return hm_product(turn >> by->turn_down, by->turn_up) - hm_product(way, pull);
}

static inline void take(int32_t* at, uint32_t row, const block* s) {
  at[0] -= s->xx, at[1] -= s->xy, at[2] -= s->xz;
  at += row;
  at[0] -= s->xy, at[1] -= s->yy, at[2] -= s->yz;
  at += row;
  at[0] -= s->xz, at[1] -= s->yz, at[2] -= s->zz;
}

static inline void add(int32_t* at, uint32_t row, const block* s) {
  at[0] += s->xx, at[1] += s->xy, at[2] += s->xz;
  at += row;
  at[0] += s->xy, at[1] += s->yy, at[2] += s->yz;
  at += row;
  at[0] += s->xz, at[1] += s->yz, at[2] += s->zz;
}

static inline void add_end(const hm_fixed_end* end, hm_fixed_state* state, const block* s) {
  take(state->weight + end->own, end->row, s);
  if (end->link != HM_PINNED) add(state->weight + end->link, end->row, s);
}

static inline int add_spring(const hm_fixed_spring* spring, hm_fixed_state* state, const scales* by) {
  const hm_fixed_end *a = &spring->end[0], *b = &spring->end[1];
  ends e;
  if (a->cell == HM_PINNED && b->cell == HM_PINNED) return 1;
  if (!look(spring, state, by, &e)) return 0;
  const block s = stiffness_of(spring, &e);
  const int32_t x = e.apart.x, y = e.apart.y, z = e.apart.z, pull = spring->pull;
  const int64_t px = pull_of(hm_upper(s.xx, x) + hm_upper(s.xy, y) + hm_upper(s.xz, z), e.stretch, e.along.x,
                             pull, by),
                py = pull_of(hm_upper(s.xy, x) + hm_upper(s.yy, y) + hm_upper(s.yz, z), e.stretch, e.along.y,
                             pull, by),
                pz = pull_of(hm_upper(s.xz, x) + hm_upper(s.yz, y) + hm_upper(s.zz, z), e.stretch, e.along.z,
                             pull, by);
  const int cut = 27 - HM_FIXED_WEIGHT;
  const block w = {s.xx >> cut, s.xy >> cut, s.xz >> cut, s.yy >> cut, s.yz >> cut, s.zz >> cut};
  if (a->cell != HM_PINNED) {
    int64_t* const bias = state->bias + 3 * a->cell;
    add_end(a, state, &w);
    bias[0] += px, bias[1] += py, bias[2] += pz;
  }
  if (b->cell != HM_PINNED) {
    int64_t* const bias = state->bias + 3 * b->cell;
    add_end(b, state, &w);
    bias[0] -= px, bias[1] -= py, bias[2] -= pz;
  }
  return 1;
}

/* V0 has unit length: the term pulls along it with 2 beta, and its W is 2 beta w w. */
static void add_unit_term(const hm_fixed_node* node, uint32_t cell, const scales* by, hm_fixed_state* state) {
  const hm_triple w = hm_triple_at(state->start + 3 * cell);
  const int32_t beta = node->weight << 3;                                                  /* Q27, as S */
  const int32_t x = hm_upper(beta, w.x), y = hm_upper(beta, w.y), z = hm_upper(beta, w.z); /* Q24 */
  int64_t* const bias = state->bias + 3 * cell;
  bias[0] += hm_product(x >> by->turn_down, by->turn_up);
  bias[1] += hm_product(y >> by->turn_down, by->turn_up);
  bias[2] += hm_product(z >> by->turn_down, by->turn_up);
  const block b = {hm_upper(x << 3, w.x), hm_upper(x << 3, w.y), hm_upper(x << 3, w.z),
                   hm_upper(y << 3, w.y), hm_upper(y << 3, w.z), hm_upper(z << 3, w.z)};
  take(state->weight + node->own, node->row, &b);
}

/* Inertia holds an output to 0: what V0 adds to the bias, it takes away again. */
static void add_inertia(const hm_fixed_node* node, hm_fixed_state* state) {
  int32_t* at = state->weight + node->own;
  at[0] -= node->weight;
  at[node->row + 1] -= node->weight;
  at[2 * node->row + 2] -= node->weight;
}

static void clear(const hm_fixed_plan* plan, hm_fixed_state* state) {
  int32_t *w = state->weight, *const end = w + plan->weights;
  for (; end - w >= 8; w += 8) w[0] = w[1] = w[2] = w[3] = w[4] = w[5] = w[6] = w[7] = 0;
  for (; w != end; ++w) *w = 0;
  for (uint32_t k = 0; k < 3 * plan->cells; ++k) state->bias[k] = 0;
}

/* A bias has the places of a product of a way and a pull, which counts finer at a larger scale, but not so
   many that a weight times an output cannot be brought there. */
static scales scales_of(const hm_fixed_plan* plan, hm_fixed_state* state) {
  const int32_t turn_places = 27 + HM_FIXED_OUTPUT - 32, most = turn_places + 30;
  const int32_t product = plan->spring_places + HM_FIXED_PULL - plan->pull_exponent + state->scale_exponent;
  state->bias_places = product < most ? product : most;
  const int32_t up = state->bias_places - turn_places, way_down = product - state->bias_places;
  return (scales){.reach = hm_fixed_reach_of(plan, state->scale_exponent),
                  .up = (uint32_t)(plan->spring_places - plan->position_places),
                  .turn_down = up < 0 ? (uint32_t)(up > -31 ? -up : 31) : 0,
                  .turn_up = up > 0 ? 1 << up : 1,
                  .way_down = (uint32_t)(way_down < 31 ? way_down : 31),
                  .longest = plan->longest,
                  .convex = (int)plan->implicit};
}

int hm_fixed_build(const hm_fixed_work* work, uint32_t* lost_node) {
  const hm_fixed_plan* plan = work->plan;
  hm_fixed_state* state = work->state;
  const scales by = scales_of(plan, state);
  clear(plan, state);
  for (const hm_fixed_spring *s = work->mesh->spring, *const end = s + plan->springs; s != end; ++s)
    if (!add_spring(s, state, &by)) return hm_fixed_lost(s->end[0].node, lost_node);
  for (uint32_t c = 0; c < plan->cells; ++c)
    if (plan->implicit)
      add_inertia(&work->mesh->node[c], state);
    else
      add_unit_term(&work->mesh->node[c], c, &by, state);
  return HM_OK;
}
