/* The firmware as the program of a core: the job in its memory tells mesh, motion and state. Whoever plays
   the core calls hm_core_begin once and then hm_core_step. */
#include "firmware/driver.h"
#include "firmware/integrator.h"
#include "firmware/riscv/core_bus.h"
#include "firmware/riscv/core_job.h"

static hm_bus bus;
static hm_driver driver;
static hm_mesh mesh;
static hm_step_parameters parameters;
static hm_state state;

#define AT(type, address) ((type*)(address)) // NOLINT: the core's addresses are 32 bits wide

static void take_mesh(const hm_core_mesh* m) {
  mesh = (hm_mesh){.nodes = m->nodes,
                   .springs = m->springs,
                   .cells = m->cells,
                   .components = m->components,
                   .axis = {m->axis[0], m->axis[1], m->axis[2]},
                   .law = m->law,
                   .floor = m->floor,
                   .spring = AT(hm_spring, m->spring),
                   .beta_weight = AT(double, m->beta_weight),
                   .cell_of_node = AT(uint32_t, m->cell_of_node),
                   .node_of_cell = AT(uint32_t, m->node_of_cell),
                   .first_link = AT(uint32_t, m->first_link),
                   .link_to = AT(uint32_t, m->link_to)};
}

static void take_motion(const hm_core_motion* m) {
  parameters = (hm_step_parameters){.formulation = hm_formulations[m->formulation],
                                    .time_step = m->time_step,
                                    .friction = m->friction,
                                    .mass = m->mass,
                                    .drag = m->drag,
                                    .gamma = m->gamma,
                                    .beta = m->beta,
                                    .acceleration_memory = m->acceleration_memory,
                                    .energy_of_all_springs = (int)m->energy_of_all_springs,
                                    .force_on_acceleration = (int)m->force_on_acceleration,
                                    .force = {m->force[0], m->force[1], m->force[2]},
                                    .node_force = AT(double, m->node_force),
                                    .threshold = m->threshold,
                                    .max_sweeps = m->max_sweeps,
                                    .expansions = m->expansions,
                                    .refinements = m->refinements};
}

static void take_state(const hm_core_state* s) {
  state = (hm_state){.position = AT(double, s->position),
                     .velocity = AT(double, s->velocity),
                     .acceleration = AT(double, s->acceleration),
                     .previous_position = AT(double, s->previous_position),
                     .previous_velocity = AT(double, s->previous_velocity),
                     .predicted = AT(double, s->predicted),
                     .energy_change = AT(double, s->energy_change),
                     .direction = AT(double, s->direction),
                     .start = AT(double, s->start),
                     .network = {AT(double, s->weight), AT(double, s->bias), AT(double, s->output)},
                     .correction = AT(double, s->correction)};
}

static void tell_driver(hm_core_answer* a) {
  a->version = driver.version;
  a->output = driver.output;
  a->weight = driver.weight;
  a->bias = driver.bias;
  a->state = driver.state;
  a->shift = driver.shift;
  a->clipped = driver.clipped;
  a->vanished = driver.vanished;
}

/* HM_OK, or the driver's error. */
int hm_core_begin(hm_core_job* job) {
  take_mesh(&job->mesh);
  take_motion(&job->motion);
  take_state(&job->state);
  bus = hm_core_bus(job->bus_master);
  int error = hm_driver_open(&driver, &bus, &mesh, AT(uint32_t, job->buffer), job->buffer_words);
  driver.stop = (hm_stop){(int)job->motion.by_sum, job->motion.share};
  if (error == HM_OK && job->motion.momentum)
    error = hm_driver_put_momentum(&driver, AT(double, job->motion.momentum), job->motion.momentum_count);
  tell_driver(&job->answer);
  return error;
}

/* The state in whole numbers, of which a core needs nothing else. */
static hm_fixed_state fixed_state(const hm_core_fixed* f) {
  return (hm_fixed_state){.position = AT(int32_t, f->position),
                          .way = AT(int32_t, f->way),
                          .predicted = AT(int32_t, f->predicted),
                          .change = AT(int32_t, f->change),
                          .output = AT(int32_t, f->output),
                          .start = AT(int32_t, f->start),
                          .direction = AT(int32_t, f->direction),
                          .next = AT(int32_t, f->next),
                          .weight = AT(int32_t, f->weight),
                          .bias = AT(int64_t, f->bias),
                          .energy = AT(int64_t, f->energy),
                          .kick = AT(int32_t, f->kick),
                          .change_exponent = f->change_exponent,
                          .step = f->step};
}

static hm_core_relaxation told(const hm_relaxation* r) {
  return (hm_core_relaxation){r->sweeps, r->converged, r->cycles};
}

static void note_sweeps(hm_core_answer* a, uint32_t sweeps) {
  if (a->relaxations < HM_CORE_RELAXATIONS) a->sweeps[a->relaxations] = sweeps;
  a->relaxations += 1;
}

static int relax(void* answer, const hm_mesh* m, hm_network* network, double threshold, uint32_t max_sweeps,
                 hm_relaxation* result) {
  hm_core_answer* a = answer;
  const int error = hm_driver_relax(&driver, m, network, threshold, max_sweeps, result);
  a->last = told(result);
  note_sweeps(a, result->sweeps);
  return error;
}

static int correct(void* answer, const hm_mesh* m, hm_network* network, double threshold, uint32_t max_sweeps,
                   hm_relaxation* result) {
  hm_core_answer* a = answer;
  const int error = hm_driver_correct(&driver, m, network, threshold, max_sweeps, result);
  a->last.sweeps += result->sweeps;
  a->last.cycles += result->cycles;
  a->last.converged = result->converged;
  note_sweeps(a, result->sweeps);
  return error;
}

static double room(void* answer) {
  (void)answer;
  return hm_driver_room(&driver);
}

static void take_kept(const hm_core_answer* a) {
  state.step = a->step;
  state.scale = a->scale;
  state.kept = (hm_kept){a->kept_reach, a->kept_inertia, a->kept_step, a->softness};
}

static void tell_step(const hm_step_result* r, hm_core_answer* a) {
  a->step = state.step;
  a->scale = state.scale;
  a->kept_reach = state.kept.reach;
  a->kept_inertia = state.kept.inertia;
  a->kept_step = state.kept.step;
  a->softness = state.kept.softness;
  a->residual = r->refinement.residual;
  a->corrections = r->refinement.corrections;
  a->refused = r->refinement.refused;
  a->lost_node = r->lost_node;
  a->all = told(&r->relaxation);
  tell_driver(a);
}

static void hear(void* answer, const hm_relaxation* one) {
  hm_core_answer* a = answer;
  a->last = told(one);
  note_sweeps(a, one->sweeps);
}

/* HM_OK, or what hm_fixed_step says. */
static int step_in_whole_numbers(hm_core_job* job) {
  hm_core_fixed* f = &job->fixed;
  hm_core_answer* a = &job->answer;
  hm_fixed_state whole = fixed_state(f);
  const hm_fixed_mesh springs = {AT(hm_fixed_spring, f->spring), AT(hm_fixed_node, f->node)};
  const hm_fixed_work work = {&f->plan, &springs, &whole, &driver, a, hear};
  hm_relaxation sum;
  const int error = hm_fixed_step(&work, &sum, &a->lost_node);
  f->change_exponent = whole.change_exponent;
  f->scale_exponent = whole.scale_exponent;
  f->bias_places = whole.bias_places;
  f->step = whole.step;
  a->all = told(&sum);
  tell_driver(a);
  return error;
}

/* HM_OK, or what hm_step says. */
int hm_core_step(hm_core_job* job) {
  if (job->fixed.whole) {
    job->answer.relaxations = 0;
    driver.clipped = driver.vanished = 0;
    return step_in_whole_numbers(job);
  }
  hm_core_answer* a = &job->answer;
  const hm_solver solver = {a, relax, correct, room};
  hm_step_result result;
  take_kept(a);
  a->relaxations = 0;
  driver.clipped = driver.vanished = 0;
  const int error = hm_step(&mesh, &parameters, &solver, &state, &result);
  tell_step(&result, a);
  return error;
}
