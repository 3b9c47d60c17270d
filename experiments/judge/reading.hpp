// SPDX-License-Identifier: BSD-3-Clause
// Readings of the columns of a trajectory that differ from the format.
#pragma once

#include "experiments/study/trajectory/trajectory_reader.hpp"

namespace polhode::study::judge {

/// Convention in which a program has written its orientations and angular velocities. Default: that of the format.
struct Reading {
  enum class Order { wxyz, xyzw, zwxy };  ///< components in the columns qw, qx, qy, qz; zwxy: reordered twice
  bool transposed = false;                ///< the orientation maps world to body
  Order order = Order::wxyz;              ///< order of the components of quaternions
  bool rates_in_body = false;             ///< ω (or L, if the file has no ω) is in the body frame
  double rate_unit = 1;                   ///< factor from ω in the file to rad/s
};

/// The quaternion in the convention of the format.
Quaternion<double> read_so(const Quaternion<double>& q, const Reading& reading);

/// The trajectory in the convention of the format. If ω is derived from L, it is derived with the corrected
/// orientation.
Trajectory read_so(Trajectory trajectory, const Reading& reading);

/// The trajectory with the times clock t_s + shift (s); rows before the scenario's start are left out.
Trajectory retimed(Trajectory trajectory, double clock, double shift);

}  // namespace polhode::study::judge
