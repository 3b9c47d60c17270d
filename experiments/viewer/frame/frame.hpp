// SPDX-License-Identifier: BSD-3-Clause
// The visible data of a run at one instant, world axes, SI units: all that the simulation's thread gives to the
// window's.
#pragma once

#include <string>
#include <vector>

#include "collision/shape.hpp"
#include "core/problem/body_snapshot.hpp"

namespace polhode::viewer::inline frame {

struct FrameContact {
  std::size_t a = 0, b = 0;
  Vector3<double> point = Vector3<double>::Zero();   ///< m
  Vector3<double> normal = Vector3<double>::Zero();  ///< unit normal from B to A
  double depth = 0;                                  ///< depth, positive if the shapes overlap, m
};

struct FrameReaction {
  Vector3<double> point = Vector3<double>::Zero();  ///< anchor of the joint on its first body, m
  Vector3<double> force = Vector3<double>::Zero();  ///< force of the joint on its first body, N
};

struct Frame {
  double t = 0;                              ///< s
  std::int64_t step = 0;                     ///< number of steps since the start of the session
  std::vector<BodySnapshot<double>> bodies;  ///< the moving ones, in the problem's order
  std::vector<FrameContact> contacts;        ///< contacts, if requested, or if the run paused at a collision
  std::vector<FrameReaction> reactions;      ///< reaction of each joint in the problem's order, if requested
  std::vector<Bounds> cells;                 ///< cells of the broad phase, if requested
  double kinetic = 0, potential = 0;         ///< J
  double energy_drift = 0;                   ///< change of the energy that the ledger cannot explain, J
  double momentum_drift = 0;                 ///< |L − L(0)|, kg m²/s
  double defect = 0;                         ///< defect of the worst orientation
};

}  // namespace polhode::viewer::frame
