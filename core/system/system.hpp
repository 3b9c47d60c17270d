// SPDX-License-Identifier: BSD-3-Clause
// A mechanical system behind one type: what the driver, the library integrators and the measurements need of it.
// Methods of our own are templates over the concrete RigidBodies (core/system/rigid_bodies.hpp), so that their loops
// inline.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/math/lanes.hpp"
#include "core/problem/problem.hpp"
#include "core/system/formulation.hpp"
#include "core/system/ode.hpp"
#include "core/system/state.hpp"

namespace polhode {

/// What can be said of a state without knowing its future or past.
template <class S>
struct Measurement {
  S kinetic{};  ///< J: ½ m v² + ½ Ω·IΩ, Ω = Rᵀω with R as stored; with L as the state ½ L·(R I⁻¹ Rᵀ L)
  S potential{};                                    ///< J
  Vector3<S> linear_momentum = Vector3<S>::Zero();  ///< kg m/s; pinned bodies count nothing
  /// kg m²/s, world axes; of one body about its reference point, of several about the world's origin. L = R I Ω.
  Vector3<S> angular_momentum = Vector3<S>::Zero();
  S orientation_defect{};  ///< largest over the bodies: | |q| − 1 |, or the Frobenius norm of RᵀR − 1

  S energy() const { return kinetic + potential; }
};

/// One body as a trajectory shows it, world axes, SI units.
template <class S>
struct BodySnapshot {
  Vector3<S> position;          ///< of the mass centre
  Quaternion<S> orientation;    ///< as stored; from the matrix by Shepperd's method
  Matrix3<S> rotation;          ///< the matrix that the equations use
  Vector3<S> velocity;          ///< of the mass centre
  Vector3<S> angular_velocity;  ///< ω
  Vector3<S> angular_momentum;  ///< about the reference point
};

template <class S>
class System : public Ode<S> {
 public:
  using Scalar = S;

  /// The problem; in an ensemble the problem of lane 0.
  const Problem& problem() const { return problems_.front(); }
  /// One, or as many as a pack has lanes.
  const std::vector<Problem>& problems() const { return problems_; }
  const Formulation& formulation() const { return formulation_; }
  const Layout& layout() const { return layout_; }
  int size() const final { return layout_.size(); }
  /// Number of moving bodies.
  std::size_t moving() const { return layout_.slots.size(); }
  const std::vector<ForcePointer<S>>& forces() const { return forces_; }
  bool has_forces() const { return !forces_.empty(); }
  bool forces_do_work() const { return forces_do_work_; }
  bool forces_exert_torques() const { return forces_exert_torques_; }
  bool forces_read_rotation() const { return forces_read_rotation_; }
  bool forces_read_velocity() const { return forces_read_velocity_; }

  /// Registers a force beyond those that the problem names: before a run, never during one.
  void add_force(ForcePointer<S> force) {
    forces_do_work_ = forces_do_work_ || force->does_work();
    for (std::size_t i = 0; i < moving(); ++i) {
      forces_exert_torques_ = forces_exert_torques_ || force->effect_on(i).torque;
    }
    forces_read_rotation_ = forces_read_rotation_ || force->reads_rotation();
    forces_read_velocity_ = forces_read_velocity_ || force->reads_velocity();
    forces_.push_back(std::move(force));
  }

  /// The state in which the problem starts, at t = 0.
  virtual State<S> start() const = 0;

  virtual Measurement<S> measure(const VectorX<S>& y) const = 0;
  virtual BodySnapshot<S> snapshot(const VectorX<S>& y, std::size_t body) const = 0;

  /// Where a body is and how it moves, static ones too, as forces see it.
  virtual BodyMotion<S> motion_of(const VectorX<S>& y, std::size_t body) const = 0;
  /// 1/(kg m²), body axes, about the reference point; of a moving body.
  virtual const Matrix3<S>& inverse_inertia(std::size_t body) const = 0;
  /// An impulse (N s) at the reference point and an angular one about it (N m s), both in world axes: what a contact
  /// does at an instant. A pinned body takes the angular part alone.
  virtual void apply_impulse(VectorX<S>& y, std::size_t body, const Vector3<S>& impulse,
                             const Vector3<S>& angular_impulse) const = 0;
  /// Moves a body by `shift` (m) and the rotation vector `turn` (rad, world axes), and leaves its velocity and angular
  /// velocity in the world as they are.
  virtual void displace(VectorX<S>& y, std::size_t body, const Vector3<S>& shift, const Vector3<S>& turn) const = 0;

  /// Moves every orientation to the nearest one on its manifold: q/|q|, or the polar factor of R.
  virtual void project(VectorX<S>& y) const = 0;

  /// True when project() can change the energy. It cannot where the equations read q/|q| only.
  bool projection_changes_energy() const {
    return formulation_.orientation == Orientation::matrix || formulation_.rotation_from == RotationFrom::stored;
  }

 protected:
  System(std::vector<Problem> problems, const Formulation& formulation);

 private:
  std::vector<Problem> problems_;
  Formulation formulation_;
  Layout layout_;
  std::vector<ForcePointer<S>> forces_;
  bool forces_do_work_ = false;
  bool forces_exert_torques_ = false;
  bool forces_read_rotation_ = false;
  bool forces_read_velocity_ = false;
};

/// Builds the instantiation that fits: one free body, or many. Throws std::invalid_argument, with the reason, for a
/// formulation that makes no sense (gyroscopic off with momentum_world) and for a problem without a moving body.
template <class S>
std::unique_ptr<System<S>> make_system(const Problem& problem, const Formulation& formulation);

/// Systems of the same non-empty key can go side by side in the lanes of an ensemble: one free body, with the same
/// kinds of forces. Their inertias, starts and parameters are their own.
std::string lane_key(const System<double>& system);
/// lane_count problems, whose systems have one key, side by side.
std::unique_ptr<System<Lanes>> make_ensemble(std::span<const Problem> problems, const Formulation& formulation);

}  // namespace polhode
