// SPDX-License-Identifier: BSD-3-Clause
// The way from a System<S> to its concrete type, for which a method of our own is compiled.
#pragma once

#include <type_traits>

#include "core/system/rigid_bodies.hpp"

namespace polhode::inline core::inline system {

/// True for double, alone or in lanes: a single body then has instantiations of its own. Float and long double serve
/// rounding studies, where speed matters less.
template <class S>
inline constexpr bool has_one_body_form = std::is_same_v<S, double> || is_lanes<S>;
/// True for a problem with a single body that is free and not joined to the world.
inline bool fits_one_body_form(const Problem& problem) {
  return problem.bodies.size() == 1 && !problem.bodies.front().pinned && problem.joints.empty();
}

/// Calls build<O, A>() with the orientation chart and the angular state of the formulation.
template <class Build>
auto in_formulation(const Formulation& formulation, const Build& build) {
  const auto chart = [&]<Orientation O>() {
    switch (formulation.angular_state) {
      case AngularState::velocity_world: return build.template operator()<O, AngularState::velocity_world>();
      case AngularState::velocity_body: return build.template operator()<O, AngularState::velocity_body>();
      default: return build.template operator()<O, AngularState::momentum_world>();
    }
  };
  return formulation.orientation == Orientation::quaternion ? chart.template operator()<Orientation::quaternion>()
                                                            : chart.template operator()<Orientation::matrix>();
}

/// Calls f with the concrete system: ManyBodies, or RigidBodies of one body in its formulation.
template <class S, class F>
auto visit_system(const System<S>& system, F&& f) {
  const auto one = [&]<Orientation O, AngularState A>() {
    return f(static_cast<const RigidBodies<S, O, A, BodyCount::one>&>(system));
  };
  if constexpr (!has_one_body_form<S>) return f(static_cast<const ManyBodies<S>&>(system));
  else if constexpr (is_lanes<S>) return in_formulation(system.formulation(), one);
  else if (const auto* many = dynamic_cast<const ManyBodies<S>*>(&system)) return f(*many);
  else return in_formulation(system.formulation(), one);
}

}  // namespace polhode::core::system
