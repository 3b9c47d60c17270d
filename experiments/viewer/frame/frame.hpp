// SPDX-License-Identifier: BSD-3-Clause
// What is seen of a run at one instant, world axes, SI units: all that the simulation's thread hands to the window's.
#pragma once

#include <string>
#include <vector>

#include "collision/shape.hpp"
#include "core/problem/body_snapshot.hpp"

namespace polhode::viewer::inline frame {

struct FrameContact {
  std::size_t a = 0, b = 0;
  Vector3<double> point = Vector3<double>::Zero();   ///< m
  Vector3<double> normal = Vector3<double>::Zero();  ///< unit, from B to A
  double depth = 0;                                  ///< m, positive when overlapping
};

struct FrameReaction {
  Vector3<double> point = Vector3<double>::Zero();  ///< anchor of the joint on its first body, m
  Vector3<double> force = Vector3<double>::Zero();  ///< of the joint on its first body, N
};

struct Frame {
  double t = 0;                              ///< s
  std::int64_t step = 0;                     ///< of the session, from its start
  std::vector<BodySnapshot<double>> bodies;  ///< the moving ones, in the problem's order
  std::vector<FrameContact> contacts;        ///< where they are asked for, or where the run paused at a collision
  std::vector<FrameReaction> reactions;      ///< of each joint in the problem's order, where they are asked for
  std::vector<Bounds> cells;                 ///< of the broad phase, where they are asked for
  double kinetic = 0, potential = 0;         ///< J
  double energy_drift = 0;                   ///< J, what the ledger cannot explain
  double momentum_drift = 0;                 ///< kg m²/s, |L − L(0)|
  double defect = 0;                         ///< of the worst orientation
};

}  // namespace polhode::viewer::frame
