// SPDX-License-Identifier: BSD-3-Clause
// The work of an impulse at a contact, parted into what restitution takes and what friction takes.
#pragma once

#include "collision/response.hpp"

namespace polhode {

struct ContactWork {
  double normal = 0, tangential = 0;  ///< J, on the bodies
};

/// `mean`: the mean of the velocities of A relative to B at the point before and after. For a jump that is exact.
inline ContactWork work_of(const ImpulseContact& c, const Vector3<double>& mean) {
  const double j = c.impulse.dot(c.normal), v = mean.dot(c.normal);
  return {j * v, c.impulse.dot(mean) - j * v};
}

}  // namespace polhode
