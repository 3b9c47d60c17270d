// SPDX-License-Identifier: BSD-3-Clause
// The exact motion of a problem, if one is known: for each body the rotation (core/exact/exact_rotation.hpp) and the
// path of the mass centre (core/exact/exact_path.hpp), separately, since they decouple in all motions known here.
#pragma once

#include <optional>
#include <vector>

#include "core/exact/exact_path.hpp"
#include "core/exact/exact_rotation.hpp"
#include "core/system/system.hpp"

namespace polhode::inline core::inline exact {

class ExactMotion {
 public:
  /// Recognises the motion from the effects of the forces of the system. It is the motion of the full equations, with
  /// the gyroscopic term.
  explicit ExactMotion(const System<double>& system);

  bool has_attitude() const { return has_attitude_; }                  ///< the attitude is known for every moving body
  bool has_angular_velocity() const { return has_angular_velocity_; }  ///< ω is known for every moving body
  bool has_position() const { return has_position_; }  ///< unpinned moving bodies exist, and their positions are known
  /// Attitude and position are known for every moving body.
  bool is_complete() const { return has_attitude_ && (has_position_ || !any_path_); }
  bool has_anything() const { return has_attitude_ || has_angular_velocity_ || has_position_; }

  struct BodyAt {
    std::optional<PathAt> path;
    std::optional<RotationAt> rotation;
  };
  /// The known parts of the motion of one body at t (s), also if they are not known for every body.
  BodyAt at(double t, std::size_t body) const;
  /// The path alone, which is quick: rotations are often elliptic functions.
  std::optional<PathAt> path_at(double t, std::size_t body) const;

  /// The path of a body; empty if it is not known.
  const ExactPath& path(std::size_t body) const { return paths_[body]; }
  /// The rotation of a body as that of a free top; null if it is none.
  const FreeTop* free_top(std::size_t body) const { return free_top_of(rotations_[body]); }
  /// Largest |ω| of a body at the start, rad/s, to which errors of ω are relative; 1 if it is 0.
  double speed_scale() const { return speed_scale_; }

  /// The state of the exact motion at the time of `near`, a state near it; the works are those of `near`. For a
  /// complete motion whose angular velocities are known.
  VectorX<double> state(const System<double>& system, const State<double>& near) const;

  struct Error {
    std::optional<double> position;          ///< largest position error of a body, m
    std::optional<double> attitude;          ///< largest attitude error of a body, rad
    std::optional<double> angular_velocity;  ///< largest error of ω of a body, over the largest |ω| at the start
    void raise(const Error& other);          ///< the larger one of each
  };
  Error error(const System<double>& system, const State<double>& state) const;

  /// What a comparison with the exact motion tells.
  struct BodyError {
    Error error;
    std::optional<Vector3<double>> angular_velocity_body;  ///< the exact one of a top, body axes, rad/s
  };
  /// The error of one body, which is `now` at t (s).
  BodyError error(double t, std::size_t body, const BodySnapshot<double>& now) const;

 private:
  bool has_attitude_ = true, has_angular_velocity_ = true, has_position_ = false;
  bool any_path_ = false;  ///< a body is not pinned
  std::vector<ExactRotation> rotations_;
  std::vector<ExactPath> paths_;
  double speed_scale_ = 1;
};

/// The momenta that the forces of a problem conserve.
struct ConservedMomenta {
  bool linear = false;
  bool angular = false;  ///< angular momentum about the reference point of a single body, or about the world's origin
};
ConservedMomenta conserved_momenta(const System<double>& system);

}  // namespace polhode::core::exact
