// CVODE around the equation of motion.
#include "sim/rivals/truth.h"

#include "sim/rivals/integrator.h"

#include <cmath>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

namespace hopmesh::rivals {
namespace {

using View = Eigen::Map<Vector>;

// y = (x, v), y' = (v, springs and surroundings - c v).
int right_hand_side(realtype, N_Vector y, N_Vector slope, void* data) {
  const auto& physics = *static_cast<const Physics*>(data);
  const Eigen::Index n = 3 * physics.nodes();
  const View x(N_VGetArrayPointer(y), n), v(N_VGetArrayPointer(y) + n, n);
  View dx(N_VGetArrayPointer(slope), n), dv(N_VGetArrayPointer(slope) + n, n);
  dx = v;
  physics.acceleration(x, v, dv);
  return 0;
}

void expect_success(int flag, const char* what) {
  if (flag < 0)
    throw LostMotion(std::string("SUNDIALS gave up in ") + what + ": " + CVodeGetReturnFlagName(flag) + ".");
}

// CVODE prints its own warnings; what it returns says the same, once.
void stay_quiet(int, const char*, const char*, char*, void*) {}

double rms_distance(const Vector& a, const Vector& b, const Physics& physics) {
  Eigen::Index moving = 0;
  for (Eigen::Index node = 0; node < physics.nodes(); ++node) moving += physics.inverse_mass()[node] != 0;
  return moving ? std::sqrt((a - b).squaredNorm() / static_cast<double>(moving)) : 0.0;
}

} // namespace

/// Everything SUNDIALS hands out, in the order in which it must be given back.
struct Walk::Solver {
  SUNContext context = nullptr;
  N_Vector y = nullptr;
  void* cvode = nullptr;
  SUNNonlinearSolver fixed_point = nullptr;
  SUNLinearSolver gmres = nullptr;
  Physics physics;
  double time = 0;

  explicit Solver(const Physics& p) : physics(p) {}
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;
  ~Solver() {
    if (cvode) CVodeFree(&cvode);
    if (fixed_point) SUNNonlinSolFree(fixed_point);
    if (gmres) SUNLinSolFree(gmres);
    if (y) N_VDestroy(y);
    if (context) SUNContext_Free(&context);
  }

  void use(Multistep multistep) {
    if (multistep == Multistep::adams) {
      fixed_point = SUNNonlinSol_FixedPoint(y, 0, context);
      expect_success(CVodeSetNonlinearSolver(cvode, fixed_point), "its set-up");
    } else {
      gmres = SUNLinSol_SPGMR(y, SUN_PREC_NONE, 30, context);
      expect_success(CVodeSetLinearSolver(cvode, gmres, nullptr), "its set-up");
    }
  }

  void walk(double target, int task) {
    expect_success(CVode(cvode, target, y, &time, task), "its walk");
    if (!std::isfinite(N_VGetArrayPointer(y)[0]))
      throw LostMotion("SUNDIALS diverged: its positions are no numbers.");
  }
};

Walk::Walk(const Physics& physics, Multistep multistep, double rtol)
    : solver_(std::make_unique<Solver>(physics)) {
  Solver& s = *solver_;
  expect_success(SUNContext_Create(nullptr, &s.context), "its set-up");
  const Eigen::Index n = 3 * physics.nodes();
  s.y = N_VNew_Serial(2 * n, s.context);
  View(N_VGetArrayPointer(s.y), n) = physics.initial_state().position;
  View(N_VGetArrayPointer(s.y) + n, n) = physics.initial_state().velocity;
  s.cvode = CVodeCreate(multistep == Multistep::adams ? CV_ADAMS : CV_BDF, s.context);
  expect_success(CVodeInit(s.cvode, right_hand_side, 0, s.y), "its set-up");
  expect_success(CVodeSetErrHandlerFn(s.cvode, stay_quiet, nullptr), "its set-up");
  expect_success(CVodeSStolerances(s.cvode, rtol, rtol), "its set-up");
  expect_success(CVodeSetUserData(s.cvode, &s.physics), "its set-up");
  expect_success(CVodeSetMaxNumSteps(s.cvode, 100'000'000), "its set-up");
  s.use(multistep);
}

Walk::~Walk() = default;

void Walk::to(double time) {
  if (time > 0) solver_->walk(time, CV_NORMAL);
}

void Walk::one_internal_step() {
  solver_->walk(INFINITY, CV_ONE_STEP);
}

Vector Walk::positions() const {
  return by_node(View(N_VGetArrayPointer(solver_->y), 3 * solver_->physics.nodes()));
}

std::uint64_t Walk::force_passes() const {
  long count = 0, for_products = 0;
  CVodeGetNumRhsEvals(solver_->cvode, &count);
  if (solver_->gmres) CVodeGetNumLinRhsEvals(solver_->cvode, &for_products);
  return static_cast<std::uint64_t>(count + for_products);
}

std::uint64_t Walk::steps() const {
  long count = 0;
  CVodeGetNumSteps(solver_->cvode, &count);
  return static_cast<std::uint64_t>(count);
}

Truth solve(const Physics& physics, const std::vector<double>& times, double rtol) {
  if (!(rtol >= 1e-14 && rtol <= 1e-3)) throw std::invalid_argument("a tolerance outside 1e-14 to 1e-3");
  double before = 0;
  for (const double time : times) {
    if (!(time >= before && std::isfinite(time)))
      throw std::invalid_argument("times that do not ascend from 0");
    before = time;
  }
  Walk adams(physics, Multistep::adams, rtol), bdf(physics, Multistep::bdf, rtol);
  Truth truth;
  for (const double time : times) {
    adams.to(time);
    bdf.to(time);
    truth.positions.push_back(adams.positions());
    truth.floor.push_back(rms_distance(truth.positions.back(), bdf.positions(), physics));
  }
  truth.force_passes = adams.force_passes() + bdf.force_passes();
  return truth;
}

} // namespace hopmesh::rivals
