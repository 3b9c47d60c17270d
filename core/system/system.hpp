// SPDX-License-Identifier: BSD-3-Clause
// Interface of a mechanical system for the simulation loop, library integrators and measurements. Polhode's own methods
// are templates over the concrete class RigidBodies (core/system/rigid_bodies.hpp), so that their loops inline.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/math/lanes.hpp"
#include "core/problem/body_snapshot.hpp"
#include "core/problem/problem.hpp"
#include "core/system/formulation.hpp"
#include "core/system/ode.hpp"
#include "core/system/state.hpp"

namespace polhode::inline core::inline system {

/// Quantities that are functions of a single state.
template <class S>
struct Measurement {
  /// Kinetic energy ½ m v² + ½ Ω·IΩ, J. Ω = Rᵀω with R as stored. For momentum_world the second term is
  /// ½ L·(R I⁻¹ Rᵀ L).
  S kinetic{};
  S potential{};                                    ///< potential energy, J
  Vector3<S> linear_momentum = Vector3<S>::Zero();  ///< total of the free bodies, world axes, kg m/s
  /// Angular momentum L = R I Ω, world axes, kg m²/s. A single body: about its reference point. Several bodies: total
  /// about the origin of the world.
  Vector3<S> angular_momentum = Vector3<S>::Zero();
  S orientation_defect{};  ///< maximum over the bodies of | |q| − 1 | or the Frobenius norm of RᵀR − 1

  /// Total energy, J.
  S energy() const { return kinetic + potential; }
};

template <class S>
class Constraints;

/// The layout of the state of a problem's system.
Layout layout_of(const Problem& problem, const Formulation& formulation);

/// Interface of a system of rigid bodies in the scalar S.
template <class S>
class System : public Ode<S> {
 public:
  using Scalar = S;

  /// The problem; in an ensemble the problem of lane 0.
  const Problem& problem() const { return problems_.front(); }
  /// One problem, or in an ensemble one for each lane.
  const std::vector<Problem>& problems() const { return problems_; }
  const Formulation& formulation() const { return formulation_; }
  const Layout& layout() const { return layout_; }
  int size() const final { return layout_.size(); }
  /// Number of moving bodies.
  std::size_t moving() const { return layout_.slots.size(); }
  const std::vector<ForcePointer<S>>& forces() const { return forces_; }
  /// True if forces or joints exert a wrench.
  bool has_forces() const { return !forces_.empty() || has_joints(); }
  bool has_joints() const { return constraints_ != nullptr; }
  /// The joints; null: the problem has none.
  const Constraints<S>* constraints() const { return constraints_.get(); }
  bool forces_do_work() const { return forces_do_work_; }
  bool forces_exert_torques() const { return forces_exert_torques_; }
  bool forces_read_rotation() const { return forces_read_rotation_; }
  bool forces_read_velocity() const { return forces_read_velocity_; }

  /// Adds a force to those of the problem. Call it only before a run.
  void add_force(ForcePointer<S> force) {
    forces_do_work_ = forces_do_work_ || force->does_work();
    for (std::size_t i = 0; i < moving(); ++i) {
      forces_exert_torques_ = forces_exert_torques_ || force->effect_on(i).torque;
    }
    forces_read_rotation_ = forces_read_rotation_ || force->reads_rotation();
    forces_read_velocity_ = forces_read_velocity_ || force->reads_velocity();
    forces_.push_back(std::move(force));
  }

  /// Initial state of the problem, at t = 0.
  virtual State<S> start() const = 0;

  virtual Measurement<S> measure(const VectorX<S>& y) const = 0;
  virtual BodySnapshot<S> snapshot(const VectorX<S>& y, std::size_t body) const = 0;

  /// Position, rotation and velocities of a body, static bodies included, as passed to forces.
  virtual BodyMotion<S> motion_of(const VectorX<S>& y, std::size_t body) const = 0;
  /// Inverse inertia tensor of a moving body about its reference point, body axes, 1/(kg m²).
  virtual const Matrix3<S>& inverse_inertia(std::size_t body) const = 0;
  /// Applies an impulse (N s) at the reference point and an angular impulse about it (N m s), both in world axes. A
  /// pinned body receives the angular impulse only.
  virtual void apply_impulse(VectorX<S>& y, std::size_t body, const Vector3<S>& impulse,
                             const Vector3<S>& angular_impulse) const = 0;
  /// Displaces a body by `shift` (m) and the rotation vector `turn` (rad), both in world axes. Its velocity and angular
  /// velocity in world axes are unchanged.
  virtual void displace(VectorX<S>& y, std::size_t body, const Vector3<S>& shift, const Vector3<S>& turn) const = 0;

  /// Projects every orientation onto its manifold: q/|q|, or the polar factor of R.
  virtual void project(VectorX<S>& y) const = 0;

  /// True if project() can change the energy. It cannot if the equations depend on q only through q/|q|.
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
  std::shared_ptr<const Constraints<S>> constraints_;
  bool forces_do_work_ = false;
  bool forces_exert_torques_ = false;
  bool forces_read_rotation_ = false;
  bool forces_read_velocity_ = false;
};

/// Builds the system of a problem, specialized for one free body or general. Throws std::invalid_argument with the
/// reason for an inconsistent formulation (gyroscopic off with momentum_world) and for a problem without a moving body.
template <class S>
std::unique_ptr<System<S>> make_system(const Problem& problem, const Formulation& formulation);

/// Compatibility key for ensembles. Systems of problems with equal non-empty keys can run side by side in lanes, unless
/// forces were added to them: each has one free body and the same kinds of forces. Inertias, initial states and
/// parameters may differ.
std::string lane_key(const Problem& problem);
/// Builds an ensemble of lane_count problems, one per lane. They must have equal non-empty keys.
std::unique_ptr<System<Lanes>> make_ensemble(std::span<const Problem> problems, const Formulation& formulation);

}  // namespace polhode::core::system
