// SPDX-License-Identifier: BSD-3-Clause
#include "integrators/joints/joint_refusal.hpp"

#include "core/system/constraints.hpp"

namespace polhode::inline integrators {

std::string joint_refusal(const Problem& problem, const Formulation& formulation, Rows needed) {
  if (problem.joints.empty()) return "it solves the equations of joints, and the scenario has none";
  if (formulation.joints.stabilization != Stabilization::none) {
    return "it solves the equations of the joints itself; leave --stabilization out";
  }
  if (!formulation.gyroscopic) return "it needs the gyroscopic term; leave --gyroscopic out";
  if (needed == Rows::independent && Constraints<double>(problem, formulation).dependent()) {
    return "equations of the joints depend on each other, and its linear system would be singular; take a method of "
           "the index-1 form, such as rk4 with --stabilization both";
  }
  return {};
}

}  // namespace polhode::integrators
