// SPDX-License-Identifier: BSD-3-Clause
// The motion of a problem as a program with a fault would compute it: with a wrong term, frame or factor in the
// equations of rotation, exactly, or with the right or wrong ones by the steps of a first-order method.
//
// States are flat, of the formulation (quaternion, velocity_world), with ω as the program would write it down.
#pragma once

#include <memory>
#include <string>

#include "core/system/system.hpp"

namespace polhode::study::judge {

/// What was made of I Ω̇ = Rᵀτ − Ω × I Ω and q̇ = ½ ω q.
struct Equations {
  /// Which ω turns what.
  enum class Frame {
    right,
    inertia_not_turned,  ///< ω̇ = I⁻¹(τ − ω × I ω) with the constant inertia of the body in world axes
    body_turns_world,    ///< Ω as it should be, but q̇ = ½ Ω q; written down as R Ω
    world_turns_body     ///< ω as it should be, but q̇ = ½ q ω
  };
  double gyroscopic = 1;  ///< factor of Ω × I Ω: 0 leaves it out, −1 has the wrong sign
  Frame frame = Frame::right;
  double turning = 1;  ///< factor of ω in q̇
};

/// A step of a first-order method.
struct FirstOrderStep {
  enum class State { velocity_world, velocity_body, momentum_world };
  enum class Order { together, velocity_first, attitude_first };  ///< which half sees the other's new value
  enum class Turn { exponential, quaternion, matrix };  ///< exp(hω), q + ½hω q, R + h[ω]R, brought back to a rotation
  State state = State::velocity_world;
  Order order = Order::together;
  Turn turn = Turn::quaternion;

  std::string words() const;  ///< "explicit Euler on q and ω"
};

class FaultyMotion {
 public:
  /// The inertia is that of the problem. FirstOrderStep::State::momentum_world asks for the right equations.
  FaultyMotion(const Problem& problem, const Equations& equations);

  const System<double>& system() const { return *system_; }

  /// The motion over `span` (s, of either sign) to about 1e-11, by Gragg's extrapolated midpoint rule of order 8. False
  /// where it takes too long or overflows.
  bool advance(double t, double span, VectorX<double>& y) const;

  void step(double t, double h, const FirstOrderStep& by, VectorX<double>& y) const;

 private:
  void rate(double t, const VectorX<double>& y, VectorX<double>& dy) const;
  bool extrapolate(double t, double h, const VectorX<double>& y, VectorX<double>& next, double& error) const;
  void change_slots(VectorX<double>& y, bool to_body) const;

  Equations equations_;
  std::unique_ptr<System<double>> system_;  ///< without the gyroscopic term
};

}  // namespace polhode::study
