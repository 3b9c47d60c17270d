// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "collision/response/penetration.hpp"
#include "collision/response.hpp"

namespace polhode {

struct SequentialSettings {
  int at_instant = 1000;     ///< iterations at most, of an impact
  int in_step = 30;          ///< and of a step
  double tolerance = 1e-12;  ///< of the largest impulse: when to stop
  PenetrationSettings penetration{};
};

std::unique_ptr<Response> make_sequential_impulses(const SequentialSettings& settings);

}  // namespace polhode
