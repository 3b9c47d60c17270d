// SPDX-License-Identifier: BSD-3-Clause
// Exact motions of free tops, one in each lane, with the digits that each has alone.
#pragma once

#include <array>

#include "core/exact/free_top.hpp"
#include "core/math/lanes.hpp"

namespace polhode::inline core::inline exact {

class FreeTops {
 public:
  /// Gives a lane this top, whose angular velocity must vary. Every lane must have one before the tops are asked.
  void set(int lane, const FreeTop& top);

  /// The motions, each at its own t (s).
  TopAt<Lanes> at(Lanes t) const;
  /// The angular velocities alone, body axes, rad/s.
  Vector3<Lanes> angular_velocity_body(Lanes t) const;

 private:
  VaryingTop<Lanes> together_;
  std::array<VaryingTop<double>, std::size_t(lane_count)> alone_;
  bool alike_ = false;  ///< one branch of the formulas serves all lanes; else each top is asked alone
};

}  // namespace polhode::core::exact
