// SPDX-License-Identifier: BSD-3-Clause
#include "core/exact/free_tops.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace polhode::inline core::inline exact {
namespace {

/// Gives a lane of a vector, quaternion or matrix these numbers.
template <class All, class One>
void set_lane(All& all, int lane, const One& one) {
  for (Eigen::Index k = 0; k < one.size(); ++k) all.data()[k].set(lane, one.data()[k]);
}

}  // namespace

void FreeTops::set(int lane, const FreeTop& top) {
  if (!top.varying()) throw std::invalid_argument("FreeTops: the angular velocity of each top must vary");
  const VaryingTop<double>& one = alone_[std::size_t(lane)] = *top.varying();
  VaryingTop<Lanes>& all = together_;
  set_lane(all.left, lane, one.left);
  set_lane(all.body_to_frame, lane, one.body_to_frame);
  set_lane(all.axes, lane, one.axes);
  set_lane(all.momentum_amplitude, lane, one.momentum_amplitude);
  set_lane(all.rate_per_momentum, lane, one.rate_per_momentum);
  all.phase.set(lane, one.phase);
  all.phase_rate.set(lane, one.phase_rate);
  all.precession_rate.set(lane, one.precession_rate);
  all.jacobi.set(lane, one.jacobi);
  all.theta.set(lane, one.theta);
  const bool transformed = one.theta.is_transformed();
  alike_ = std::all_of(alone_.begin(), alone_.end(), [&](const VaryingTop<double>& other) {
    return std::isfinite(other.jacobi.quarter_period()) && other.theta.is_transformed() == transformed;
  });
}

TopAt<Lanes> FreeTops::at(Lanes t) const {
  if (alike_) return together_.at(t);
  TopAt<Lanes> all;
  for (int i = 0; i < lane_count; ++i) {
    const TopAt<double> one = alone_[std::size_t(i)].at(t[i]);
    set_lane(all.orientation, i, one.orientation);
    set_lane(all.angular_velocity_body, i, one.angular_velocity_body);
  }
  return all;
}

Vector3<Lanes> FreeTops::angular_velocity_body(Lanes t) const {
  if (alike_) return together_.angular_velocity_body(t);
  Vector3<Lanes> all;
  for (int i = 0; i < lane_count; ++i) set_lane(all, i, alone_[std::size_t(i)].angular_velocity_body(t[i]));
  return all;
}

}  // namespace polhode::core::exact
