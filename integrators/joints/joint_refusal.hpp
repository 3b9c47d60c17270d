// SPDX-License-Identifier: BSD-3-Clause
// The problems that methods which solve the equations of joints themselves cannot take.
#pragma once

#include <string>

#include "core/problem/problem.hpp"
#include "core/system/formulation.hpp"

namespace polhode::inline integrators {

enum class Rows { may_depend, independent };

/// The reason why such a method does not apply: no joints, a stabilization of the index-1 form, or, if it needs
/// independent equations, some that depend on others. Empty if it does.
std::string joint_refusal(const Problem& problem, const Formulation& formulation, Rows needed);

}  // namespace polhode::integrators
