// SPDX-License-Identifier: BSD-3-Clause
// The inertias that programs put in the place of a body's own by mistake.
#pragma once

#include <string>
#include <vector>

#include "core/problem/problem.hpp"

namespace polhode::study::judge {

struct OtherInertia {
  Matrix3<double> inertia;  ///< kg m², body axes, about the body's reference point
  std::string words;        ///< what it is, as a clause
};

/// Each inertia that is possible and makes a difference to the motion, once. A motion without torques depends neither
/// on a common factor of the inertia, nor on an isotropic inertia otherwise than by the absence of ω × Iω, which is
/// another fault; these are left out.
std::vector<OtherInertia> other_inertias(const Body& body, bool forces_exert_torques);

}  // namespace polhode::study
