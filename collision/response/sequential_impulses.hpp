// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "collision/response.hpp"
#include "collision/response/position_correction.hpp"

namespace polhode::inline collision::inline response {

struct SequentialSettings {
  int at_instant = 1000;             ///< limit of iterations, for an impact at an instant
  double instant_tolerance = 1e-14;  ///< change, over the largest impulse, below which the iteration stops
  int in_step = 20;                  ///< limit of iterations, for a step in which bodies collide
  int at_rest = 100;  ///< limit of iterations, for a step in which all contacts rest; too few make a stack lean
  double step_tolerance = 1e-6;  ///< the same for a step; the next step starts from its impulses
  PositionCorrectionSettings position_correction{};
};

std::unique_ptr<Response> make_sequential_impulses(const SequentialSettings& settings);

}  // namespace polhode::collision::response
