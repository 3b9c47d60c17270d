// SPDX-License-Identifier: BSD-3-Clause
// CVODE's variable-order, variable-step linear multistep methods: Adams–Moulton (orders 1 to 12, fixed-point
// iteration) and backward differentiation (orders 1 to 5, Newton iteration, dense difference-quotient Jacobian).
// Source: Hindmarsh et al., SUNDIALS, ACM TOMS 31 (2005); the CVODE 6.4 user guide.
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <new>
#include <stdexcept>

#include "integrators/catalogue.hpp"

namespace polhode {
namespace {

/// Deletes what SUNDIALS made, by its own function.
template <auto destroy>
struct Destroy {
  template <class T>
  void operator()(T* object) const {
    destroy(object);
  }
};
void free_context(SUNContext context) { SUNContext_Free(&context); }
void free_memory(void* memory) { CVodeFree(&memory); }
using Context = std::unique_ptr<_SUNContext, Destroy<free_context>>;
using Vector = std::unique_ptr<_generic_N_Vector, Destroy<N_VDestroy>>;
using Matrix = std::unique_ptr<_generic_SUNMatrix, Destroy<SUNMatDestroy>>;
using LinearSolver = std::unique_ptr<_generic_SUNLinearSolver, Destroy<SUNLinSolFree>>;
using NonlinearSolver = std::unique_ptr<_generic_SUNNonlinearSolver, Destroy<SUNNonlinSolFree>>;
using Memory = std::unique_ptr<void, Destroy<free_memory>>;

constexpr long max_steps = 100000000;  // between two returns; CVODE's 500 is meant for users who wait for an output

class Cvode final : public Integrator<double> {
 public:
  Cvode(const System<double>& system, const IntegratorSettings& settings, int method)
      : system_(system), tolerance_(settings.tolerance), method_(method) {
    SUNContext context = nullptr;
    if (SUNContext_Create(nullptr, &context) != 0) throw std::bad_alloc();
    context_.reset(context);
  }

  void begin(const State<double>& state) override {
    const sunindextype n = state.y.size();
    memory_.reset(CVodeCreate(method_, context_.get()));
    work_.reset(N_VNew_Serial(n, context_.get()));
    if (!memory_ || !work_) throw std::bad_alloc();
    // CVODE prints its complaints on stderr unless told otherwise; ours go into the run's message.
    check(CVodeSetErrFile(memory_.get(), nullptr), "CVodeSetErrFile");
    copy_in(state);
    check(CVodeInit(memory_.get(), &right_hand_side, state.t, work_.get()), "CVodeInit");
    check(CVodeSetUserData(memory_.get(), const_cast<System<double>*>(&system_)), "CVodeSetUserData");
    check(CVodeSStolerances(memory_.get(), tolerance_, tolerance_), "CVodeSStolerances");
    check(CVodeSetMaxNumSteps(memory_.get(), max_steps), "CVodeSetMaxNumSteps");
    if (method_ == CV_BDF) {
      matrix_.reset(SUNDenseMatrix(n, n, context_.get()));
      linear_.reset(SUNLinSol_Dense(work_.get(), matrix_.get(), context_.get()));
      if (!matrix_ || !linear_) throw std::bad_alloc();
      check(CVodeSetLinearSolver(memory_.get(), linear_.get(), matrix_.get()), "CVodeSetLinearSolver");
    } else {
      nonlinear_.reset(SUNNonlinSol_FixedPoint(work_.get(), 0, context_.get()));
      if (!nonlinear_) throw std::bad_alloc();
      check(CVodeSetNonlinearSolver(memory_.get(), nonlinear_.get()), "CVodeSetNonlinearSolver");
    }
    evaluations_before_ = 0;
    stepped_ = false;
  }

  StepResult step(State<double>& state, double h) override {
    const double target = state.t + h;
    check(CVodeSetStopTime(memory_.get(), target), "CVodeSetStopTime");
    double t = state.t;
    const int flag = CVode(memory_.get(), target, work_.get(), &t, CV_ONE_STEP);
    stepped_ = true;
    if (flag < 0) {
      char* name = CVodeGetReturnFlagName(flag);
      StepResult result{std::string("CVODE gave up (") + name + ")"};
      std::free(name);
      return result;
    }
    // Where the right-hand side ceases to be a number CVODE halves its step for ever and calls that a success.
    if (!(t > state.t)) return {"CVODE's step size fell to nothing"};
    state.t = t;
    const double* y = N_VGetArrayPointer(work_.get());
    state.y = Eigen::Map<const VectorX<double>>(y, state.y.size());
    return {};
  }

  std::int64_t evaluations() const override {
    return evaluations_before_ + right_hand_sides();
  }

  void discard_history(const State<double>& state) override {
    evaluations_before_ += right_hand_sides();
    copy_in(state);
    check(CVodeReInit(memory_.get(), state.t, work_.get()), "CVodeReInit");
    stepped_ = false;
  }

  bool has_dense_output() const override { return true; }
  bool interpolate(double t, State<double>& state) const override {
    Vector y(N_VMake_Serial(state.y.size(), state.y.data(), context_.get()));
    if (!y || CVodeGetDky(memory_.get(), t, 0, y.get()) != CV_SUCCESS) return false;
    state.t = t;
    return true;
  }

 private:
  static int right_hand_side(double t, N_Vector y, N_Vector dy, void* system) {
    static_cast<const System<double>*>(system)->rate(t, N_VGetArrayPointer(y), N_VGetArrayPointer(dy));
    return 0;
  }

  static void check(int flag, const char* function) {
    if (flag != CV_SUCCESS) throw std::runtime_error(std::string(function) + " failed with " + std::to_string(flag));
  }

  void copy_in(const State<double>& state) {
    Eigen::Map<VectorX<double>>(N_VGetArrayPointer(work_.get()), state.y.size()) = state.y;
  }

  std::int64_t right_hand_sides() const {
    long own = 0, jacobian = 0;
    CVodeGetNumRhsEvals(memory_.get(), &own);
    // CVodeReInit forgets the first number at once, the second one at the next step only.
    if (method_ == CV_BDF && stepped_) CVodeGetNumLinRhsEvals(memory_.get(), &jacobian);
    return own + jacobian;
  }

  const System<double>& system_;
  double tolerance_;
  int method_;
  std::int64_t evaluations_before_ = 0;
  bool stepped_ = false;  ///< since the last (re)start
  // In the order in which SUNDIALS wants them made; destroyed in the reverse.
  Context context_;
  Vector work_;
  Matrix matrix_;
  LinearSolver linear_;
  NonlinearSolver nonlinear_;
  Memory memory_;
};

IntegratorEntry entry(Declaration declaration, int method) {
  return {std::move(declaration), [method](const System<double>& system, const IntegratorSettings& settings) {
            return std::make_unique<Cvode>(system, settings, method);
          }};
}

}  // namespace

IntegratorEntry cvode_adams() {
  return entry({.name = "cvode_adams",
                .family = "SUNDIALS",
                .summary = "CVODE, Adams-Moulton of orders 1 to 12, fixed-point iteration, variable step",
                .adaptive = true,
                .implicit = true,
                .multi_step = true},
               CV_ADAMS);
}

IntegratorEntry cvode_bdf() {
  return entry({.name = "cvode_bdf",
                .family = "SUNDIALS",
                .summary = "CVODE, backward differentiation of orders 1 to 5, Newton iteration, variable step",
                .adaptive = true,
                .implicit = true,
                .multi_step = true},
               CV_BDF);
}

}  // namespace polhode
