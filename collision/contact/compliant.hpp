// SPDX-License-Identifier: BSD-3-Clause
// The response `compliant`: each point of contact is a spring and a damper, and its friction a smooth function of slip.
// It is a force like any other, so that every method integrates through the impact.
//
// With d the depth of a point, n the normal from B to A, and u the slip of A on B:
//   normal    f = max(0, k d + c ḋ)           Kelvin and Voigt's, kept from pulling
//   friction  −μ f u/√(|u|² + s²)             Coulomb's, regularised (Oden & Martins, Computer Methods in Applied
//   Mechanics
//                                             and Engineering 52, 1985)
// The damper is c = 2 ζ √(k m), m the mass that a push along n finds at the point, and ζ that with which the rebound of
// two bodies that meet head on has the pair's restitution e, at any speed (Schwager & Pöschel, Granular Matter 9,
// 2007):
//   e = exp(−2 ζ arccos(ζ)/√(1 − ζ²))
// The damper of Hunt & Crossley (Journal of Applied Mechanics 42, 1975), c ~ d, would start smoothly, but on this
// spring its restitution tends to 1 as the impact becomes slow. A pair whose e is below e⁻² = 0.135 is damped
// critically, and so rebounds by that much. What presses on a surface that is pulled sideways creeps: under a share q <
// 1 of what friction can bear, by the slip s q/√(1 − q²).
//
// Without a stiffness k is such that an elastic impact of the two would last 5 ms: π √(m'/k), m' their reduced mass. A
// face that lies on another is one spring for each corner of their patch.
//
// How smooth: while the same points touch, as of a ball on a plane, the force is smooth, and a method keeps its order.
// Where a point begins to touch or ceases to, the spring's force has a kink, and fixed steps across it have order 2;
// the damper's jumps by c ḋ where the point begins to touch, and order 1 is left. Patches of two faces change their
// points at some depth too, by jumps. A method that chooses its steps makes them short at all these; what begins and
// ends within one of them it does not see.
//
// Energy: the spring's, ½ k d², is potential energy where the depth of each point depends on the poses alone and
// smoothly: of spheres and ellipsoids, and of boxes and capsules on half-spaces. The rest is work: what damper and
// friction take, and of other pairs the springs' too.
#pragma once

#include <vector>

#include "collision/contact/contact_scene.hpp"
#include "core/problem/force.hpp"

namespace polhode::inline collision {

class Compliant final : public ForceModel<double> {
 public:
  Compliant(const System<double>& system, ContactScene& scene, const Compliance& compliance);

  void add_wrench(double t, std::span<const BodyMotion<double>> bodies,
                  std::span<Wrench<double>> wrenches) const override;
  double potential_energy(std::span<const BodyMotion<double>> bodies) const override;
  bool does_work() const override { return true; }
  double power(double t, std::span<const BodyMotion<double>> bodies) const override;
  bool internal() const override { return scene_.all_free(); }
  Effect effect_on(std::size_t) const override { return {true, std::nullopt}; }

 private:
  struct Matter {
    double mass;                      ///< kg, infinite where static
    double inverse_mass;              ///< 1/kg, as a push finds it: 0 when pinned
    Matrix3<double> inverse_inertia;  ///< 1/(kg m²), body axes, about the reference point
    Vector3<double> center;           ///< m, body axes: of the mass, from the reference point
    double damping_ratio;             ///< ζ
  };
  /// What one point does to A, in its parts.
  struct Push {
    double spring = 0, normal = 0;   ///< N: k d, and f
    double sinking = 0;              ///< m/s: ḋ
    Vector3<double> slip, friction;  ///< m/s, N
  };

  std::span<const ImpulseContact> contacts(std::span<const BodyMotion<double>> bodies) const;
  Push push_of(const ImpulseContact& c, std::span<const BodyMotion<double>> bodies) const;
  double stiffness_of(const ImpulseContact& c) const;
  double mobility_of(std::uint32_t i, const BodyMotion<double>& body, const ImpulseContact& c) const;
  bool has_potential(const ImpulseContact& c) const;

  ContactScene& scene_;
  Compliance compliance_;
  std::vector<Matter> matter_;
  // What was found last; an evaluation of the force asks for it more than once.
  mutable std::vector<Pose> poses_, seen_;
  mutable std::span<const ImpulseContact> contacts_;
};

/// ζ, from 0 to 1, of the damper with which a head-on rebound has the restitution e.
double damping_ratio(double restitution);

}  // namespace polhode
