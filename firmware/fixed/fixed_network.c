/* Weights and biases in whole numbers: docs/method/theory.md, section 2, with the bias gathered spring by
   spring. I = -W V0 - g is the sum over a node's springs of S (V0_i - V0_j) - f, and what the node's own term
   leaves. */
#include "firmware/fixed/fixed_parts.h"

enum {
  ONE = 1 << 28
}; /* slack is Q28; of a spring below an eighth of its rest length it stays just below 8 */

/* A symmetric block: 00 01 02 11 12 22. */
typedef struct block {
  int32_t of[6];
} block;

/* What a step knows before its springs. */
typedef struct scales {
  hm_fixed_reach reach;
  uint32_t up;        /* from places of a position to those of a spring */
  uint32_t pull_down; /* from the product of a way, a direction and a pull to the bias */
  uint32_t turn_down; /* from weight times output to the bias */
  int32_t longest;
  int convex;
} scales;

typedef struct ends {
  int32_t apart[3]; /* V0_i - V0_j, Q29 */
  int32_t along[3]; /* u over its length, Q29 */
  int32_t stretch;  /* length - rest length, in places of a spring */
  int32_t slack;    /* rest length over length, Q28 */
} ends;

hm_fixed_reach hm_fixed_reach_of(const hm_fixed_plan* plan, int32_t scale_exponent) {
  return (hm_fixed_reach){plan->h, (uint32_t)(28 - plan->spring_places - plan->h_exponent - scale_exponent)};
}

static inline int32_t slack_of(const hm_root* root, int32_t rest, int32_t length, int convex) {
  if (convex && rest >= length) return ONE;
  if (rest >> 3 >= length - 1) return INT32_MAX;
  return (int32_t)hm_shifted((int64_t)((uint64_t)(uint32_t)rest * root->inverse), 34 - root->half);
}

/* 0 where the spring is longer than numbers reach. */
static inline int look(const hm_fixed_spring* spring, const hm_fixed_state* state, const scales* by,
                       ends* e) {
  static const int32_t nowhere[3] = {0, 0, 0};
  const hm_fixed_end *a = &spring->end[0], *b = &spring->end[1];
  const int32_t *at = state->predicted + 3 * a->node, *to = state->predicted + 3 * b->node;
  const int32_t* v = a->cell == HM_PINNED ? nowhere : state->start + 3 * a->cell;
  const int32_t* w = b->cell == HM_PINNED ? nowhere : state->start + 3 * b->cell;
  int32_t u[3];
  for (uint32_t p = 0; p < 3; ++p) {
    const int32_t away = (int32_t)((uint32_t)at[p] - (uint32_t)to[p]);
    if (away > by->longest || away < -by->longest) return 0;
    e->apart[p] = v[p] - w[p];
    u[p] = (int32_t)((uint32_t)away << by->up) + hm_fixed_reached(&by->reach, e->apart[p]);
  }
  const uint64_t square = hm_square_of(u);
  e->along[0] = e->along[1] = e->along[2] = e->stretch = e->slack = 0;
  if (square == 0) return 1;
  const hm_root root = hm_root_of(square);
  const int32_t length = (int32_t)hm_length_of(&root);
  for (uint32_t p = 0; p < 3; ++p) e->along[p] = hm_along(&root, u[p]);
  e->stretch = length - spring->rest;
  e->slack = slack_of(&root, spring->rest, length, by->convex);
  return 1;
}

/* S = a ((1 - slack) 1 + slack w w), in Q27. */
static inline block stiffness_of(const hm_fixed_spring* spring, const ends* e) {
  const int32_t x = e->along[0] << 2, y = e->along[1] << 2, z = e->along[2] << 2; /* Q31, below 1 */
  const int32_t sx = hm_upper(e->slack, x) << 1, sy = hm_upper(e->slack, y) << 1,
                sz = hm_upper(e->slack, z) << 1; /* Q28 */
  const int32_t round = (ONE - e->slack) >> 1;   /* Q27 */
  block s = {{hm_upper(sx, x) + round, hm_upper(sx, y), hm_upper(sx, z), hm_upper(sy, y) + round,
              hm_upper(sy, z), hm_upper(sz, z) + round}};
  if (spring->stiffness == 1 << 30) return s;
  for (uint32_t k = 0; k < 6; ++k) s.of[k] = hm_upper(s.of[k], spring->stiffness) << 2;
  return s;
}

/* S (V0_i - V0_j) - f. */
static inline void pull_of(const hm_fixed_spring* spring, const ends* e, const block* s, const scales* by,
                           int64_t pull[3]) {
  const int64_t x = e->apart[0], y = e->apart[1], z = e->apart[2];
  const int32_t* of = s->of;
  const int64_t turn[3] = {of[0] * x + of[1] * y + of[2] * z, of[1] * x + of[3] * y + of[4] * z,
                           of[2] * x + of[4] * y + of[5] * z};
  for (uint32_t p = 0; p < 3; ++p) {
    const int32_t way = (int32_t)((int64_t)e->stretch * e->along[p] >> HM_FIXED_OUTPUT);
    pull[p] = hm_shifted(turn[p], by->turn_down) - hm_shifted((int64_t)way * spring->pull, by->pull_down);
  }
}

static inline void take(int32_t* at, uint32_t row, const block* s) {
  const int32_t* of = s->of;
  at[0] -= of[0], at[1] -= of[1], at[2] -= of[2];
  at += row;
  at[0] -= of[1], at[1] -= of[3], at[2] -= of[4];
  at += row;
  at[0] -= of[2], at[1] -= of[4], at[2] -= of[5];
}

static inline void add(int32_t* at, uint32_t row, const block* s) {
  const int32_t* of = s->of;
  at[0] += of[0], at[1] += of[1], at[2] += of[2];
  at += row;
  at[0] += of[1], at[1] += of[3], at[2] += of[4];
  at += row;
  at[0] += of[2], at[1] += of[4], at[2] += of[5];
}

static inline void add_end(const hm_fixed_end* end, hm_fixed_state* state, const block* s) {
  take(state->weight + end->own, end->row, s);
  if (end->link != HM_PINNED) add(state->weight + end->link, end->row, s);
}

static inline int add_spring(const hm_fixed_spring* spring, hm_fixed_state* state, const scales* by) {
  const hm_fixed_end *a = &spring->end[0], *b = &spring->end[1];
  ends e;
  int64_t pull[3];
  if (a->cell == HM_PINNED && b->cell == HM_PINNED) return 1;
  if (!look(spring, state, by, &e)) return 0;
  block s = stiffness_of(spring, &e);
  pull_of(spring, &e, &s, by, pull);
  for (uint32_t k = 0; k < 6; ++k) s.of[k] >>= 27 - HM_FIXED_WEIGHT;
  if (a->cell != HM_PINNED) {
    add_end(a, state, &s);
    for (uint32_t p = 0; p < 3; ++p) state->bias[3 * a->cell + p] += pull[p];
  }
  if (b->cell != HM_PINNED) {
    add_end(b, state, &s);
    for (uint32_t p = 0; p < 3; ++p) state->bias[3 * b->cell + p] -= pull[p];
  }
  return 1;
}

/* V0 has unit length: the term pulls along it with 2 beta, and its W is 2 beta w w. */
static void add_unit_term(const hm_fixed_node* node, uint32_t cell, hm_fixed_state* state) {
  const int32_t* w = state->start + 3 * cell;
  int32_t scaled[3];
  block b;
  for (uint32_t p = 0; p < 3; ++p) {
    scaled[p] = (int32_t)((int64_t)node->weight * w[p] >> HM_FIXED_OUTPUT);
    const int64_t fine = (int64_t)node->weight * w[p]; /* weight times output */
    state->bias[3 * cell + p] +=
        hm_shifted(fine, (uint32_t)(HM_FIXED_WEIGHT + HM_FIXED_OUTPUT - state->bias_places));
  }
  for (uint32_t p = 0, k = 0; p < 3; ++p)
    for (uint32_t q = p; q < 3; ++q, ++k) b.of[k] = (int32_t)((int64_t)scaled[p] * w[q] >> HM_FIXED_OUTPUT);
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

/* A pull counts finer at a larger scale: the bias has as many places as its products have, at most 28. */
static scales scales_of(const hm_fixed_plan* plan, hm_fixed_state* state) {
  const int32_t product = plan->spring_places + 30 - plan->pull_exponent + state->scale_exponent;
  state->bias_places = product < 28 ? product : 28;
  return (scales){.reach = hm_fixed_reach_of(plan, state->scale_exponent),
                  .up = (uint32_t)(plan->spring_places - plan->position_places),
                  .pull_down = (uint32_t)(product - state->bias_places),
                  .turn_down = (uint32_t)(27 + HM_FIXED_OUTPUT - state->bias_places),
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
      add_unit_term(&work->mesh->node[c], c, state);
  return HM_OK;
}
