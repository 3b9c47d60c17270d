// SPDX-License-Identifier: BSD-3-Clause
// The exact motion of a problem, where there is one: the attitude of every body on which no torque acts (the free top)
// and the path of the mass centre where the force on it is constant: p = p0 + v0 t + f t²/(2m).
#pragma once

#include <optional>
#include <vector>

#include "core/free_top.hpp"
#include "core/system.hpp"

namespace polhode {

class ExactMotion {
 public:
  /// Looks at what the forces of the system can do; the motion is that of the full equations, with the gyroscopic term.
  explicit ExactMotion(const System<double>& system);

  bool has_attitude() const { return has_attitude_; }  ///< for every moving body
  bool has_position() const { return has_position_; }  ///< for every moving body that is not pinned, if there is one

  struct Error {
    std::optional<double> position;          ///< m, largest over the bodies
    std::optional<double> attitude;          ///< rad, likewise
    std::optional<double> angular_velocity;  ///< relative to the largest |ω| at the start
  };
  Error error(const System<double>& system, const State<double>& state) const;

 private:
  struct Path {
    Vector3<double> position, velocity, acceleration;
  };
  bool has_attitude_ = true, has_position_ = false;
  std::vector<FreeTop> tops_;
  std::vector<std::optional<Path>> paths_;
  double speed_scale_ = 1;  ///< rad/s
};

/// Which of a problem's momenta its forces conserve.
struct ConservedMomenta {
  bool linear = false;
  bool angular = false;  ///< of one body about its reference point, of several about the world's origin
};
ConservedMomenta conserved_momenta(const System<double>& system);

}  // namespace polhode
