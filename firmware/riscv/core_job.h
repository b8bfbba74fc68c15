/* What a core beside the array is given and answers, in its memory: numbers and its own addresses alone, so
   that the layout is alike for everybody. */
#ifndef HOPMESH_FIRMWARE_CORE_JOB_H
#define HOPMESH_FIRMWARE_CORE_JOB_H

#include "firmware/fixed/fixed.h"

enum { HM_CORE_RELAXATIONS = 256 }; /* of a step that are told one by one */

/* As hm_mesh. */
typedef struct hm_core_mesh {
  uint32_t nodes, springs, cells, components, axis[3];
  int32_t law;
  double floor;
  uint32_t spring, beta_weight, cell_of_node, node_of_cell, first_link, link_to; /* addresses */
} hm_core_mesh;

/* As hm_step_parameters, and what the driver is asked for. */
typedef struct hm_core_motion {
  double time_step, friction, mass, drag, gamma, beta, acceleration_memory, force[3], threshold, share;
  uint32_t formulation; /* its place in hm_formulations */
  uint32_t energy_of_all_springs, force_on_acceleration, max_sweeps, expansions, refinements, by_sum;
  uint32_t node_force, momentum; /* addresses, or 0 */
  uint32_t momentum_count;
} hm_core_motion;

/* As hm_state: addresses; those of what a motion has no use for are 0. */
typedef struct hm_core_state {
  uint32_t position, velocity, acceleration, previous_position, previous_velocity, predicted, energy_change,
      direction, start, weight, bias, output, correction;
} hm_core_state;

/* As hm_fixed_mesh and hm_fixed_state, for a motion in whole numbers: addresses, and what is none. */
typedef struct hm_core_fixed {
  hm_fixed_plan plan;
  uint32_t whole; /* 1: steps are made in whole numbers */
  uint32_t spring, node;
  uint32_t position, way, predicted, change, output, start, direction, next, weight, bias, energy, kick;
  int32_t change_exponent, scale_exponent, bias_places;
  uint32_t step;
} hm_core_fixed;

/* As hm_relaxation. */
typedef struct hm_core_relaxation {
  uint32_t sweeps, converged;
  uint64_t cycles;
} hm_core_relaxation;

/* What changes from step to step: kept as in hm_state, answers as hm_step_result and hm_driver have them. */
typedef struct hm_core_answer {
  uint64_t step;
  double scale;
  double kept_reach, kept_inertia;
  uint64_t kept_step;
  double softness;
  double residual;
  hm_core_relaxation all, last;
  uint32_t corrections, refused, lost_node;
  uint32_t clipped, vanished;
  int32_t shift;
  uint32_t version, output;
  hm_format weight, bias, state;
  uint32_t relaxations; /* of the step; the first of them: */
  uint32_t sweeps[HM_CORE_RELAXATIONS];
} hm_core_answer;

typedef struct hm_core_job {
  hm_core_mesh mesh;
  hm_core_motion motion;
  hm_core_state state;
  hm_core_fixed fixed;
  uint32_t buffer, buffer_words;
  uint32_t bus_master; /* 0: the core copies every word itself */
  hm_core_answer answer;
} hm_core_job;

#endif
