// SPDX-License-Identifier: BSD-3-Clause
// The concepts of a mechanical system: the operations that a method may use, in groups, with the identities that each
// group satisfies. A method states the group that it uses: static_assert(LieGroup<System>). The laws in
// tests/laws/motion_law_test.cpp check every identity in every formulation, for one body, for many bodies, and in
// lanes. core/system/rigid_bodies.hpp lists the files of the operations.
//
// y is a flat state (q, v, work). A Tangent has the layout of v: for each body a linear part, unless the body is
// pinned, and an angular part. ξ, θ, η are tangent vectors. t and h are in s.
#pragma once

#include <concepts>

#include "core/math/linear_algebra.hpp"
#include "core/math/quaternion.hpp"

namespace polhode::inline core::inline system {

template <class S>
struct BodyConstants;

/// The flat ODE ẏ = f(t, y).
///   rate(t, y, dy):  dy = f(t, y) = (N(q) v, v̇, power). Every entry of dy is written.
template <class System>
concept FlatOde = requires(const System& system, typename System::Scalar t, const typename System::Flat& y,
                           typename System::Flat& dy) {
  { system.zero() } -> std::same_as<typename System::Flat>;
  system.rate(t, y, dy);
};

/// A flat ODE in two parts, which together are bitwise equal to rate().
///   acceleration(t, y, dy):        velocity_part(dy) = v̇(t, q, v). The other entries of dy are unchanged.
///   configuration_rate(t, y, dy):  configuration_part(dy) = N(q) v, work_part(dy) = power. The others are unchanged.
template <class System>
concept PartitionedOde = FlatOde<System> && requires(const System& system, typename System::Scalar t,
                                                     const typename System::Flat& y, typename System::Flat& dy) {
  system.acceleration(t, y, dy);
  system.configuration_rate(t, y, dy);
  system.configuration_part(dy);
  system.velocity_part(dy);
  system.work_part(dy);
};

/// Configurations as elements of the group SO(3)ⁿ × R³ⁿ. q ⊕ ξ is (p + ξ, exp(ξ) R) with ξ in world axes, or
/// (p + ξ, R exp(ξ)) with ξ in body axes. The axes are those of the formulation's angular velocity.
///   q ⊕ 0 = q.
///   twist(y, ξ):            d/ds (q ⊕ s ξ) = N(q) v at s = 0.
///   retract(y, ξ):          q ← q ⊕ ξ. v and work are unchanged. Orientations stay on their manifold.
///   dexp_inverse(θ, η, θ̇):  d/ds (q ⊕ (θ + s θ̇)) = d/ds ((q ⊕ θ) ⊕ s η) at s = 0.
/// Source: Iserles, Munthe-Kaas, Nørsett & Zanna, Lie-group methods, Acta Numerica 9 (2000).
template <class System>
concept LieGroup = PartitionedOde<System> &&
    requires(const System& system, typename System::Flat& y, typename System::Tangent& xi,
             const typename System::Tangent& theta, const typename System::Tangent& eta) {
  { system.zero_tangent() } -> std::same_as<typename System::Tangent>;
  system.twist(y, xi);
  system.retract(y, xi);
  system.dexp_inverse(theta, eta, xi);
};

/// Momenta and wrenches in world axes. Angular parts are about the reference points of the bodies.
///   wrench(t, y, w):     w = (f, τ), the total force (N) and torque (N m) on each body.
///   momentum(y, p):      p = (m v, R I Rᵀ ω).
///   set_momentum(p, y):  inverse of momentum(): afterwards momentum(y) = p. q and work are unchanged.
template <class System>
concept InertiaMap = requires(const System& system, typename System::Scalar t, typename System::Flat& y,
                              typename System::Tangent& p) {
  system.wrench(t, y, p);
  system.momentum(y, p);
  system.set_momentum(p, y);
};

/// The motion in body axes, Ω = Rᵀω, in every formulation.
///   body_twist(y, ξ):            ξ = (v, Ω).
///   set_body_twist(ξ, y):        inverse of body_twist(): afterwards body_twist(y) = ξ. q and work are unchanged.
///   body_acceleration(y, w, a):  a = (f/m, I⁻¹(Rᵀτ − Ω × IΩ)) under the wrench w = (f, τ).
///   retract_in_body(y, ξ):       q ← (p + ξ, R exp(ξ)). For ξ = s (v, Ω), dq/ds = N(q) v at s = 0.
///   bracket(a, b, c):            c = [a, b] = (0, a × b): exp(εa) exp(εb) exp(−εa) exp(−εb) = exp(ε²[a, b] + O(ε³)).
///   carry_momentum(θ, j, y):     q as by retract_in_body(y, θ). The momentum increases by j.
template <class System>
concept BodyFrame = PartitionedOde<System> && InertiaMap<System> &&
    requires(const System& system, typename System::Flat& y, typename System::Tangent& out,
             const typename System::Tangent& a, const typename System::Tangent& b) {
  { system.zero_tangent() } -> std::same_as<typename System::Tangent>;
  system.body_twist(y, out);
  system.set_body_twist(a, y);
  system.body_acceleration(y, a, out);
  system.retract_in_body(y, a);
  system.bracket(a, b, out);
  system.carry_momentum(a, b, y);
};

/// The splitting of the motion into kicks (forces act, configurations are fixed) and free flow (no forces act).
///   kick(t, h, y):        The momentum increases by h w(t, y), and the work by the trapezoidal rule for the power over
///                         the kick. q is unchanged. If w does not depend on v, the kick is the exact flow.
///   kick(t, h, seen, y):  The momentum increases by h w(t, seen), the work by h P(t, seen). The states seen and y
///                         have the same q.
///   free_flow(h, y, rotor):  Motion over h without forces. World momentum and work are unchanged.
///                         rotor(constants, h, m) advances the angular momentum m (principal axes) of a body over h and
///                         returns the unit quaternion of the rotation dR, R' = R dR. The flow is exact if the rotor
///                         is exact, and conserves the energy if the rotor does.
///   forces_read_velocity():  true if w depends on v.
/// An ensemble in lanes has no free_flow(), so it does not satisfy this concept.
template <class System>
concept Splitting = PartitionedOde<System> &&
    requires(const System& system, typename System::Scalar t, typename System::Scalar h,
             const typename System::Flat& seen, typename System::Flat& y,
             Quaternion<typename System::Scalar> (*rotor)(const BodyConstants<typename System::Scalar>&,
                                                          typename System::Scalar, Vector3<typename System::Scalar>&)) {
  system.kick(t, h, y);
  system.kick(t, h, seen, y);
  system.free_flow(h, y, rotor);
  { system.forces_read_velocity() } -> std::same_as<bool>;
};

/// Measurement of a state and its projection onto the manifold, on the array of its numbers.
///   project_flat(y):  replaces every orientation by the nearest one on its manifold. Idempotent. Orientations on the
///                     manifold, positions, velocities and work are unchanged.
///   measure_flat(y):  energies, momenta and the orientation defect.
///   projection_changes_energy():  false if every state has the same energy as its projection.
template <class System>
concept Measurable = requires(const System& system, const typename System::Scalar* y, typename System::Scalar* moved) {
  system.measure_flat(y);
  system.project_flat(moved);
  { system.projection_changes_energy() } -> std::same_as<bool>;
};

/// All operations of a system of rigid bodies whose scalar is a floating-point type (not lanes).
template <class System>
concept MechanicalSystem = LieGroup<System> && BodyFrame<System> && Splitting<System> && Measurable<System>;

}  // namespace polhode::core::system
