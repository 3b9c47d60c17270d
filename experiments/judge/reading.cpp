// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/reading.hpp"

#include <algorithm>
#include <utility>

namespace polhode::study::judge {

Quaternion<double> read_so(const Quaternion<double>& q, const Reading& reading) {
  Quaternion<double> meant = q;
  if (reading.order == Reading::Order::xyzw) meant = {q[3], q[0], q[1], q[2]};
  if (reading.order == Reading::Order::zwxy) meant = {q[1], q[2], q[3], q[0]};
  return reading.transposed ? conjugate<double>(meant) : meant;
}

Trajectory read_so(Trajectory trajectory, const Reading& reading) {
  for (BodySnapshot<double>& body : trajectory.bodies) {
    if (trajectory.has_matrix) {
      if (reading.transposed) body.rotation = body.rotation.transpose().eval();
      body.orientation = quaternion_from_rotation_matrix(body.rotation);
    } else {
      body.orientation = read_so(body.orientation, reading);
      body.rotation = rotation_matrix(body.orientation);
    }
    body.angular_velocity *= reading.rate_unit;
    if (!reading.rates_in_body) continue;
    Vector3<double>& rate = trajectory.has_angular_velocity ? body.angular_velocity : body.angular_momentum;
    rate = (body.rotation * rate).eval();
  }
  return trajectory;
}

Trajectory retimed(Trajectory trajectory, double clock, double shift) {
  for (double& t : trajectory.times) t = clock * t + shift;
  const auto first = std::lower_bound(trajectory.times.begin(), trajectory.times.end(), 0.0);
  const auto late = first - trajectory.times.begin();
  trajectory.times.erase(trajectory.times.begin(), first);
  trajectory.bodies.erase(trajectory.bodies.begin(),
                          trajectory.bodies.begin() + late * static_cast<std::ptrdiff_t>(trajectory.moving));
  if (trajectory.has_energy) trajectory.energy.erase(trajectory.energy.begin(), trajectory.energy.begin() + late);
  return trajectory;
}

}  // namespace polhode::study::judge
