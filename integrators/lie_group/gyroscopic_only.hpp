// SPDX-License-Identifier: BSD-3-Clause
// Refusal of formulations without the gyroscopic term, for methods that update the momentum.
#pragma once

#include <string>

#include "core/problem/problem.hpp"
#include "core/system/formulation.hpp"

namespace polhode::inline integrators {

inline std::string needs_the_gyroscopic_term(const Problem&, const Formulation& formulation) {
  return formulation.gyroscopic ? "" : "it moves the angular momentum, which has no gyroscopic term to leave out";
}

}  // namespace polhode::integrators
