// SPDX-License-Identifier: BSD-3-Clause
// Inertias that programs use by mistake instead of a body's inertia.
#pragma once

#include <string>
#include <vector>

#include "core/problem/problem.hpp"

namespace polhode::study::judge {

struct OtherInertia {
  Matrix3<double> inertia;  ///< inertia about the body's reference point, body frame, kg m²
  std::string words;        ///< description, as a clause
};

/// All physically possible wrong inertias that change the motion, without duplicates. If no forces exert torques, two
/// kinds are left out: multiples of the inertia, which do not change the motion, and isotropic inertias, whose only
/// effect is that ω × Iω vanishes, which is another fault.
std::vector<OtherInertia> other_inertias(const Body& body, bool forces_exert_torques);

}  // namespace polhode::study::judge
