// SPDX-License-Identifier: BSD-3-Clause
// ARKODE's embedded explicit Runge–Kutta methods with error control. The default table has order 4 (Zonneveld 5(3)4);
// the setting `order` selects orders 2 to 8 (Heun–Euler, Bogacki–Shampine, Zonneveld, Cash–Karp, Verner 6(5),
// Fehlberg 8(7) for 7 and 8). Source: Reynolds et al., ARKODE, ACM TOMS 49 (2023); the ARKODE 5.4 user guide, "Butcher
// tables".
#include <arkode/arkode_erkstep.h>

#include <cstdlib>
#include <new>

#include "integrators/sundials/sundials_integrator.hpp"

namespace polhode::inline integrators {
namespace {

using namespace sundials;

void free_erk(void* memory) { ERKStepFree(&memory); }
using ErkMemory = std::unique_ptr<void, Destroy<free_erk>>;

class ArkodeErk final : public SundialsIntegrator {
 public:
  static Setting order() { return table_order(2, 8); }

  ArkodeErk(const System<double>& system, const IntegratorSettings& settings)
      : SundialsIntegrator(system, settings), order_(static_cast<int>(settings.whole(order()))) {
    if (projects_joints()) project_within_steps(settings.project);
  }

 private:
  void create(double t, N_Vector y, SundialsIntegrator* self) override {
    memory_.reset(ERKStepCreate(&right_hand_side, t, y, context()));
    if (!memory_) throw std::bad_alloc();
    check(ERKStepSetErrFile(memory_.get(), nullptr), "ERKStepSetErrFile");
    check(ERKStepSetUserData(memory_.get(), self), "ERKStepSetUserData");
    check(ERKStepSetOrder(memory_.get(), order_), "ERKStepSetOrder");
    check(ERKStepSStolerances(memory_.get(), tolerance(), tolerance()), "ERKStepSStolerances");
    check(ERKStepSetMaxNumSteps(memory_.get(), max_steps), "ERKStepSetMaxNumSteps");
    if (projects_within_steps()) {
      check(ERKStepSetPostprocessStepFn(memory_.get(), &project_step), "ERKStepSetPostprocessStepFn");
    }
  }

  void restart(double t, N_Vector y) override {
    double h = 0;
    check(ERKStepGetCurrentStep(memory_.get(), &h), "ERKStepGetCurrentStep");
    check(ERKStepReInit(memory_.get(), &right_hand_side, t, y), "ERKStepReInit");
    check(ERKStepSetInitStep(memory_.get(), h), "ERKStepSetInitStep");
  }

  int evolve(double stop, N_Vector y, double* t) override {
    check(ERKStepSetStopTime(memory_.get(), stop), "ERKStepSetStopTime");
    return ERKStepEvolve(memory_.get(), stop, y, t, ARK_ONE_STEP);
  }

  int derivative(double t, N_Vector y) const override { return ERKStepGetDky(memory_.get(), t, 0, y); }
  int watch(int count) override { return ERKStepRootInit(memory_.get(), count, &find_roots); }
  int roots(int* signs) override { return ERKStepGetRootInfo(memory_.get(), signs); }
  std::string flag_name(int flag) const override {
    const std::unique_ptr<char, decltype(&std::free)> name(ERKStepGetReturnFlagName(flag), &std::free);
    return name.get();
  }
  const char* library() const override { return "ARKODE"; }

  int order_;
  ErkMemory memory_;
};

}  // namespace

IntegratorEntry arkode_erk() {
  return {{.name = "arkode_erk",
           .family = "SUNDIALS",
           .summary = "ARKODE, embedded explicit Runge-Kutta of order 4 (Zonneveld)",
           .equation = R"(Y_i &= y_n + h \textstyle\sum_{j<i} a_{ij}\,f(t_n + c_j h, Y_j), \quad
  y_{n+1} = y_n + h \sum_i b_i\,f(t_n + c_i h, Y_i) \\
e &= h \textstyle\sum_i (b_i - \tilde b_i)\,f(t_n + c_i h, Y_i), \quad
  \text{accepted if } \Bigl(\tfrac1N \textstyle\sum_i (e_i/w_i)^2\Bigr)^{1/2} \le 1 \\
  & w_i = \mathrm{tol}\,(|y_i| + 1))",
           .sources = {"reynolds2023"},
           .order = 4,
           .adaptive = true,
           .settings = {ArkodeErk::order()}},
          [](const System<double>& system, const IntegratorSettings& settings) {
            return std::make_unique<ArkodeErk>(system, settings);
          }};
}

}  // namespace polhode::integrators
