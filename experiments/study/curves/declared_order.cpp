// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/curves/declared_order.hpp"

namespace polhode::study::inline curves {
namespace {

bool torque_acts(const Scenario& scenario) {
  const auto system = make_system<double>(scenario.problem, {});  // that of a refused run cannot be made
  for (std::size_t i = 0; i < system->moving(); ++i) {
    for (const auto& force : system->forces()) {
      if (force->effect_on(i).torque) return true;
    }
  }
  return false;
}

}  // namespace

std::optional<double> declared_order(const Declaration& method, const Scenario& scenario, bool attitude) {
  const bool free =
      scenario.problem.joints.empty() && (scenario.problem.forces.empty() || (attitude && !torque_acts(scenario)));
  const int order = free && method.free_order > 0 ? method.free_order : method.order;
  return order == Declaration::exact_order ? std::nullopt : std::optional<double>(order);
}

std::optional<double> declared_reaction_order(const Declaration& method, const Scenario& scenario) {
  return method.multiplier_order > 0 ? method.multiplier_order : declared_order(method, scenario, false);
}

std::optional<double> declared_order(const Declaration& method, const RunRecord& run, bool attitude) {
  return run.scenario ? declared_order(method, *run.scenario, attitude) : std::optional<double>(method.order);
}

}  // namespace polhode::study::curves
