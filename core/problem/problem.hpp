// SPDX-License-Identifier: BSD-3-Clause
// An initial value problem of mechanics: bodies, their initial states, the forces on them and the joints between them.
#pragma once

#include <vector>

#include "core/problem/body.hpp"
#include "core/problem/force_kind.hpp"
#include "core/problem/joint_kind.hpp"

namespace polhode::inline core::inline problem {

/// Moving bodies stand first, static ones last; forces and joints name bodies by their index here.
struct Problem {
  std::vector<Body> bodies;
  std::vector<BodyStart> starts;
  std::vector<ForceParameters> forces;
  std::vector<JointParameters> joints{};

  std::size_t moving() const {
    std::size_t n = 0;
    while (n < bodies.size() && !bodies[n].fixed) ++n;
    return n;
  }
};

}  // namespace polhode::core::problem
