// SPDX-License-Identifier: BSD-3-Clause
// Motion of a problem as computed by a program with a fault: either the exact solution of equations of rotation with a
// wrong term, frame or factor, or the steps of a first-order method.
//
// States are flat, in the formulation (quaternion, velocity_world), with ω as the program would write it to a file.
#pragma once

#include <memory>
#include <string>

#include "core/system/system.hpp"

namespace polhode::study::judge {

/// Equations of rotation, modified from I Ω̇ = Rᵀτ − Ω × I Ω and q̇ = ½ ω q. Ω is the angular velocity in the body
/// frame, ω that in the world frame.
struct Equations {
  /// Frames of the angular velocity and of the inertia.
  enum class Frame {
    right,
    inertia_not_turned,  ///< ω̇ = I⁻¹(τ − ω × I ω) with the constant body-frame inertia
    body_turns_world,    ///< right equation of Ω, but q̇ = ½ Ω q; Ω is written to files as R Ω
    world_turns_body     ///< right equation of ω, but q̇ = ½ q ω
  };
  double gyroscopic = 1;  ///< factor of Ω × I Ω; 0: term left out, −1: wrong sign
  Frame frame = Frame::right;
  double turning = 1;  ///< factor of ω in q̇
};

/// A first-order method.
struct FirstOrderStep {
  enum class State { velocity_world, velocity_body, momentum_world };
  enum class Order { together, velocity_first, attitude_first };  ///< order of updates; the second uses the first
  enum class Turn { exponential, quaternion, matrix };  ///< exp(hω); q + ½hω q; R + h[ω]R, projected to a rotation
  State state = State::velocity_world;
  Order order = Order::together;
  Turn turn = Turn::quaternion;

  std::string words() const;  ///< name of the method: "explicit Euler on q and ω"
};

class FaultyMotion {
 public:
  /// The inertia is that of the problem. FirstOrderStep::State::momentum_world requires the right equations.
  FaultyMotion(const Problem& problem, const Equations& equations);

  const System<double>& system() const { return *system_; }

  /// Advances y from time t (s) by `span` (s, of either sign) with errors of about 1e-11, by Gragg's extrapolated
  /// midpoint rule of order 8. Returns false if it takes too many steps or overflows.
  bool advance(double t, double span, VectorX<double>& y) const;
  /// Advances y from time t (s) by one step h (s) of a first-order method.

  void step(double t, double h, const FirstOrderStep& by, VectorX<double>& y) const;

 private:
  void rate(double t, const VectorX<double>& y, VectorX<double>& dy) const;
  bool extrapolate(double t, double h, const VectorX<double>& y, VectorX<double>& next, double& error) const;
  void change_slots(VectorX<double>& y, bool to_body) const;

  Equations equations_;
  std::unique_ptr<System<double>> system_;  ///< system without the gyroscopic term
};

}  // namespace polhode::study::judge
