// SPDX-License-Identifier: BSD-3-Clause
// The refusal of methods that move the momentum itself.
#pragma once

#include <string>

#include "core/problem/problem.hpp"
#include "core/system/formulation.hpp"

namespace polhode::inline integrators {

inline std::string needs_the_gyroscopic_term(const Problem&, const Formulation& formulation) {
  return formulation.gyroscopic ? "" : "it moves the angular momentum, which has no gyroscopic term to leave out";
}

}  // namespace polhode
