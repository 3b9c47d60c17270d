// SPDX-License-Identifier: BSD-3-Clause
// CVODE's variable-order, variable-step linear multistep methods: Adams–Moulton (orders 1 to 12, fixed-point
// iteration) and backward differentiation (orders 1 to 5, Newton iteration, dense difference-quotient Jacobian).
// If a run requests projection, backward differentiation projects the orientations and the joints within its steps and
// continues without a restart. Its dense output between two steps deviates from the manifold by about the tolerance.
// Source: Hindmarsh et al., SUNDIALS, ACM TOMS 31 (2005); Eich, SIAM J. Numer. Anal. 30 (1993), on projection; the
// CVODE 6.4 user guide.
#include <cvode/cvode.h>
#include <cvode/cvode_proj.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <cstdlib>
#include <new>

#include "integrators/sundials/sundials_integrator.hpp"

namespace polhode::inline integrators {
namespace {

using namespace sundials;

void free_cvode(void* memory) { CVodeFree(&memory); }
using CvodeMemory = std::unique_ptr<void, Destroy<free_cvode>>;

class Cvode final : public SundialsIntegrator {
 public:
  Cvode(const System<double>& system, const IntegratorSettings& settings, int method)
      : SundialsIntegrator(system, settings), method_(method) {
    if (method == CV_BDF && (settings.project || projects_joints())) project_within_steps(settings.project);
  }

 private:
  void create(double t, N_Vector y, SundialsIntegrator* self) override {
    memory_.reset(CVodeCreate(method_, context()));
    if (!memory_) throw std::bad_alloc();
    // Suppress CVODE's messages on stderr. Errors go into the message of the run instead.
    check(CVodeSetErrFile(memory_.get(), nullptr), "CVodeSetErrFile");
    check(CVodeInit(memory_.get(), &right_hand_side, t, y), "CVodeInit");
    check(CVodeSetUserData(memory_.get(), self), "CVodeSetUserData");
    check(CVodeSStolerances(memory_.get(), tolerance(), tolerance()), "CVodeSStolerances");
    check(CVodeSetMaxNumSteps(memory_.get(), max_steps), "CVodeSetMaxNumSteps");
    if (method_ == CV_BDF) {
      const sunindextype n = N_VGetLength(y);
      matrix_.reset(SUNDenseMatrix(n, n, context()));
      linear_.reset(SUNLinSol_Dense(y, matrix_.get(), context()));
      if (!matrix_ || !linear_) throw std::bad_alloc();
      check(CVodeSetLinearSolver(memory_.get(), linear_.get(), matrix_.get()), "CVodeSetLinearSolver");
    } else {
      nonlinear_.reset(SUNNonlinSol_FixedPoint(y, 0, context()));
      if (!nonlinear_) throw std::bad_alloc();
      check(CVodeSetNonlinearSolver(memory_.get(), nonlinear_.get()), "CVodeSetNonlinearSolver");
    }
    if (projects_within_steps()) {
      check(CVodeSetProjFn(memory_.get(), &correct), "CVodeSetProjFn");
      check(CVodeSetProjErrEst(memory_.get(), SUNFALSE), "CVodeSetProjErrEst");
    }
  }

  void restart(double t, N_Vector y) override {
    double h = 0;
    check(CVodeGetCurrentStep(memory_.get(), &h), "CVodeGetCurrentStep");
    check(CVodeReInit(memory_.get(), t, y), "CVodeReInit");
    check(CVodeSetInitStep(memory_.get(), h), "CVodeSetInitStep");
  }

  int evolve(double stop, N_Vector y, double* t) override {
    check(CVodeSetStopTime(memory_.get(), stop), "CVodeSetStopTime");
    return CVode(memory_.get(), stop, y, t, CV_ONE_STEP);
  }

  int derivative(double t, N_Vector y) const override { return CVodeGetDky(memory_.get(), t, 0, y); }
  int watch(int count) override { return CVodeRootInit(memory_.get(), count, &find_roots); }
  int roots(int* signs) override { return CVodeGetRootInfo(memory_.get(), signs); }
  std::optional<long> iterations_counted() const override {
    long count = 0;
    check(CVodeGetNumNonlinSolvIters(memory_.get(), &count), "CVodeGetNumNonlinSolvIters");
    return count;
  }
  std::string flag_name(int flag) const override {
    const std::unique_ptr<char, decltype(&std::free)> name(CVodeGetReturnFlagName(flag), &std::free);
    return name.get();
  }
  const char* library() const override { return "CVODE"; }

  /// Projection function of CVODE: corr = P(y) − y.
  static int correct(double, N_Vector y, N_Vector corr, double, N_Vector, void* user_data) {
    auto& self = static_cast<Cvode&>(*static_cast<SundialsIntegrator*>(user_data));
    const VectorX<double> before = Eigen::Map<const VectorX<double>>(N_VGetArrayPointer(y), N_VGetLength(y));
    VectorX<double> after = before;
    if (!self.project(after)) return 1;
    Eigen::Map<VectorX<double>>(N_VGetArrayPointer(corr), after.size()) = after - before;
    return 0;
  }

  int method_;
  Matrix matrix_;
  LinearSolver linear_;
  NonlinearSolver nonlinear_;
  CvodeMemory memory_;
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
                .equation =
                    R"(y_n &= y_{n-1} + h_n \textstyle\sum_{i=0}^{q-1} \beta_{n,i}\,f(t_{n-i}, y_{n-i}), \quad
  q = 1, \dots, 12 \\
\text{accepted if}\quad & \Bigl(\tfrac1N \textstyle\sum_i (e_i/w_i)^2\Bigr)^{1/2} \le 1, \quad
  w_i = \mathrm{tol}\,(|y_i| + 1))",
                .sources = {"hindmarsh2005", "hairerNorsettWanner1993"},
                .adaptive = true,
                .implicit = true,
                .multi_step = true},
               CV_ADAMS);
}

IntegratorEntry cvode_bdf() {
  return entry(
      {.name = "cvode_bdf",
       .family = "SUNDIALS",
       .summary = "CVODE, backward differentiation of orders 1 to 5, Newton iteration, variable step",
       .equation =
           R"(\textstyle\sum_{i=0}^{q} \alpha_{n,i}\,y_{n-i} &= h_n\,\beta_{n,0}\,f(t_n, y_n), \quad q = 1, \dots, 5 \\
\text{accepted if}\quad & \Bigl(\tfrac1N \textstyle\sum_i (e_i/w_i)^2\Bigr)^{1/2} \le 1, \quad
  w_i = \mathrm{tol}\,(|y_i| + 1))",
       .sources = {"hindmarsh2005", "eich1993", "hairerWanner1996"},
       .adaptive = true,
       .implicit = true,
       .multi_step = true},
      CV_BDF);
}

}  // namespace polhode::integrators
