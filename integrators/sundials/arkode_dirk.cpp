// SPDX-License-Identifier: BSD-3-Clause
// ARKODE's embedded diagonally implicit Runge–Kutta methods with error control, Newton iteration and a dense
// difference-quotient Jacobian. The default table has order 4 (SDIRK 5(3)4, L-stable); the setting `order`
// selects orders 2 to 5. Source: Hairer & Wanner, Solving Ordinary Differential Equations II, IV.6; Reynolds et al.,
// ARKODE, ACM TOMS 49 (2023).
#include <arkode/arkode_arkstep.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <cstdlib>
#include <new>

#include "integrators/sundials/sundials_integrator.hpp"

namespace polhode::inline integrators {
namespace {

using namespace sundials;

void free_dirk(void* memory) { ARKStepFree(&memory); }
using DirkMemory = std::unique_ptr<void, Destroy<free_dirk>>;

class ArkodeDirk final : public SundialsIntegrator {
 public:
  static Setting order() { return table_order(2, 5); }

  ArkodeDirk(const System<double>& system, const IntegratorSettings& settings)
      : SundialsIntegrator(system, settings), order_(static_cast<int>(settings.whole(order()))) {
    if (projects_joints()) project_within_steps(settings.project);
  }

 private:
  void create(double t, N_Vector y, SundialsIntegrator* self) override {
    const sunindextype n = N_VGetLength(y);
    memory_.reset(ARKStepCreate(nullptr, &right_hand_side, t, y, context()));
    matrix_.reset(SUNDenseMatrix(n, n, context()));
    linear_.reset(SUNLinSol_Dense(y, matrix_.get(), context()));
    if (!memory_ || !matrix_ || !linear_) throw std::bad_alloc();
    check(ARKStepSetErrFile(memory_.get(), nullptr), "ARKStepSetErrFile");
    check(ARKStepSetUserData(memory_.get(), self), "ARKStepSetUserData");
    check(ARKStepSetOrder(memory_.get(), order_), "ARKStepSetOrder");
    check(ARKStepSStolerances(memory_.get(), tolerance(), tolerance()), "ARKStepSStolerances");
    check(ARKStepSetMaxNumSteps(memory_.get(), max_steps), "ARKStepSetMaxNumSteps");
    if (projects_within_steps()) {
      check(ARKStepSetPostprocessStepFn(memory_.get(), &project_step), "ARKStepSetPostprocessStepFn");
    }
    check(ARKStepSetLinearSolver(memory_.get(), linear_.get(), matrix_.get()), "ARKStepSetLinearSolver");
  }

  void restart(double t, N_Vector y) override {
    double h = 0;
    check(ARKStepGetCurrentStep(memory_.get(), &h), "ARKStepGetCurrentStep");
    check(ARKStepReInit(memory_.get(), nullptr, &right_hand_side, t, y), "ARKStepReInit");
    check(ARKStepSetInitStep(memory_.get(), h), "ARKStepSetInitStep");
  }

  int evolve(double stop, N_Vector y, double* t) override {
    check(ARKStepSetStopTime(memory_.get(), stop), "ARKStepSetStopTime");
    return ARKStepEvolve(memory_.get(), stop, y, t, ARK_ONE_STEP);
  }

  int derivative(double t, N_Vector y) const override { return ARKStepGetDky(memory_.get(), t, 0, y); }
  int watch(int count) override { return ARKStepRootInit(memory_.get(), count, &find_roots); }
  int roots(int* signs) override { return ARKStepGetRootInfo(memory_.get(), signs); }
  std::optional<long> iterations_counted() const override {
    long count = 0;
    check(ARKStepGetNumNonlinSolvIters(memory_.get(), &count), "ARKStepGetNumNonlinSolvIters");
    return count;
  }
  std::string flag_name(int flag) const override {
    const std::unique_ptr<char, decltype(&std::free)> name(ARKStepGetReturnFlagName(flag), &std::free);
    return name.get();
  }
  const char* library() const override { return "ARKODE"; }

  int order_;
  Matrix matrix_;
  LinearSolver linear_;
  DirkMemory memory_;
};

}  // namespace

IntegratorEntry arkode_dirk() {
  return {{.name = "arkode_dirk",
           .family = "SUNDIALS",
           .summary = "ARKODE, embedded diagonally implicit Runge-Kutta of order 4",
           .equation = R"(Y_i &= y_n + h \textstyle\sum_{j \le i} a_{ij}\,f(t_n + c_j h, Y_j), \quad
  y_{n+1} = y_n + h \sum_i b_i\,f(t_n + c_i h, Y_i) \\
e &= h \textstyle\sum_i (b_i - \tilde b_i)\,f(t_n + c_i h, Y_i), \quad
  \text{accepted if } \Bigl(\tfrac1N \textstyle\sum_i (e_i/w_i)^2\Bigr)^{1/2} \le 1 \\
  & w_i = \mathrm{tol}\,(|y_i| + 1))",
           .sources = {"reynolds2023", "hairerWanner1996"},
           .order = 4,
           .adaptive = true,
           .implicit = true,
           .settings = {ArkodeDirk::order()}},
          [](const System<double>& system, const IntegratorSettings& settings) {
            return std::make_unique<ArkodeDirk>(system, settings);
          }};
}

}  // namespace polhode::integrators
