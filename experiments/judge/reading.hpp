// SPDX-License-Identifier: BSD-3-Clause
// What the columns of a trajectory may mean other than the format says.
#pragma once

#include "experiments/study/trajectory/trajectory_reader.hpp"

namespace polhode::study::judge {

/// How a program may have written its orientations and rates; as it stands, the format's own.
struct Reading {
  enum class Order { wxyz, xyzw, zwxy };  ///< what stands under qw, qx, qy, qz; the last is xyzw once too often
  bool transposed = false;                ///< the orientation takes world to body
  Order order = Order::wxyz;              ///< of a quaternion
  bool rates_in_body = false;             ///< ω, or where there is none L, is in body axes
  double rate_unit = 1;                   ///< ω in the file times this is in rad/s
};

/// The quaternion that was meant.
Quaternion<double> read_so(const Quaternion<double>& q, const Reading& reading);

/// The trajectory that was meant, in the format's own terms. Derived ω (from L alone) goes by the orientation that was
/// meant, as everywhere.
Trajectory read_so(Trajectory trajectory, const Reading& reading);

/// The same motion at `clock` t_s + `shift` (s); what would lie before the scenario's start is left out.
Trajectory retimed(Trajectory trajectory, double clock, double shift);

}  // namespace polhode::study
