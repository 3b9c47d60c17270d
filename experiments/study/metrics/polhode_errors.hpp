// SPDX-License-Identifier: BSD-3-Clause
// Polhode errors of the bodies in all lanes at once, each with the digits that PolhodeError gives alone.
#pragma once

#include <array>
#include <cstddef>

#include "core/exact/free_tops.hpp"
#include "experiments/study/metrics/polhode_error.hpp"

namespace polhode::study::inline metrics {

class PolhodeErrors {
 public:
  struct At {
    Lanes phase, phase_rad, off;  ///< as in PolhodeError::At
  };

  /// Continues the error of the body in a lane, which must outlive its last at(). Every lane must have one.
  void set(std::size_t lane, PolhodeError& one);
  /// The error alone goes on where that in its lane is, and that in the lane where the error alone is.
  void give(std::size_t lane) const;
  void take(std::size_t lane);

  /// The errors at times t (s) in the lanes that are due; those of others mean nothing. tops: the exact motions of the
  /// bodies. exact_omega: their angular velocities at t, body axes, rad/s.
  At at(Lanes t, const BodySnapshot<Lanes>& body, const FreeTops& tops, const Vector3<Lanes>& exact_omega,
        Lanes::Mask due);

 private:
  std::array<PolhodeError*, std::size_t(lane_count)> alone_{};
  PolhodeCurve<Lanes> curve_;
  Lanes t_ = 0, phase_ = 0, phase_rate_ = 0;  ///< of the last call, as in PolhodeError
};

}  // namespace polhode::study::metrics
