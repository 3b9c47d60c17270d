// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "collision/response.hpp"
#include "collision/response/position_correction.hpp"

namespace polhode {

struct SequentialSettings {
  int at_instant = 1000;             ///< iterations at most, of an impact at an instant
  double instant_tolerance = 1e-14;  ///< of the largest impulse: when to stop
  int in_step = 20;                  ///< iterations at most, of a step in which something strikes
  int at_rest = 100;                 ///< and of one in which all rests, where a stack would lean by what is left over
  double step_tolerance = 1e-6;      ///< of the largest impulse; what a step leaves, the next begins with
  PenetrationSettings penetration{};
};

std::unique_ptr<Response> make_sequential_impulses(const SequentialSettings& settings);

}  // namespace polhode
