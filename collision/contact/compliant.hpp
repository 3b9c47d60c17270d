// SPDX-License-Identifier: BSD-3-Clause
// The response `compliant`: each contact point is a spring and a damper; friction is a smooth function of slip. It is a
// force like any other, so that every method integrates through the impact.
//
// With d the depth of a point, n the normal from B to A, and u the slip of A on B:
//   normal    f = max(0, k d + c ḋ)           Kelvin and Voigt's, kept from pulling
//   friction  −μ f u/√(|u|² + s²)             Coulomb's, regularised
// (Oden & Martins, Computer Methods in Applied Mechanics and Engineering 52, 1985.)
// The damper is c = 2 ζ √(k m), m the effective mass along n at the point. ζ gives a head-on rebound of two bodies the
// restitution e of the pair, at any speed (Schwager & Pöschel, Granular Matter 9, 2007):
//   e = exp(−2 ζ arccos(ζ)/√(1 − ζ²))
// The damper of Hunt & Crossley (Journal of Applied Mechanics 42, 1975), c ~ d, would start smoothly, but on this
// spring its restitution tends to 1 as the impact becomes slow. A pair whose e is below e⁻² = 0.135 is damped
// critically, and so rebounds by that much. A body at rest under a tangential load creeps: at a share q < 1 of the
// friction limit, with the slip s q/√(1 − q²).
//
// The default stiffness k makes an elastic impact of the two bodies last 5 ms: π √(m'/k), m' their reduced mass. Two
// faces in contact have one spring at each corner of their patch.
//
// Smoothness: as long as the same points touch, as for a ball on a plane, the force is smooth, and a method has its
// order. When a point begins or ceases to touch, the force of the spring has a kink, and fixed steps across it have
// order 2; the force of the damper jumps by c ḋ when the point begins to touch, which leaves order 1. Patches of two
// faces also change their points at some depth, by jumps. An adaptive method takes short steps there; it misses a
// contact that begins and ends within one step.
//
// Energy: the spring's, ½ k d², is potential energy where the depth of each point depends on the poses alone and
// smoothly: spheres and ellipsoids, boxes and capsules on half-spaces. The rest is work: that of damper and friction,
// and for other pairs that of the springs too.
#pragma once

#include <vector>

#include "collision/contact/contact_scene.hpp"
#include "core/problem/force.hpp"

namespace polhode::inline collision::inline contact {

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
    double mass;                      ///< mass, infinite for a static body, kg
    double inverse_mass;              ///< inverse of the mass, 0 for a pinned body, 1/kg
    Matrix3<double> inverse_inertia;  ///< inverse inertia about the reference point, body axes, 1/(kg m²)
    Vector3<double> center;           ///< mass centre from the reference point, body axes, m
    double damping_ratio;             ///< damping ratio ζ
  };
  /// The force of one point on A, by parts.
  struct Push {
    double spring = 0, normal = 0;   ///< elastic part k d, and the whole normal force f, N
    double sinking = 0;              ///< rate ḋ of the depth, m/s
    Vector3<double> slip, friction;  ///< relative velocity along the surfaces, m/s; friction on A, N
  };

  std::span<const ImpulseContact> contacts(std::span<const BodyMotion<double>> bodies) const;
  Push push_of(const ImpulseContact& c, std::span<const BodyMotion<double>> bodies) const;
  double stiffness_of(const ImpulseContact& c) const;
  double mobility_of(std::uint32_t i, const BodyMotion<double>& body, const ImpulseContact& c) const;
  bool has_potential(const ImpulseContact& c) const;

  ContactScene& scene_;
  Compliance compliance_;
  std::vector<Matter> matter_;
  // The result of the last query; one evaluation of the force needs it more than once.
  mutable std::vector<Pose> poses_, seen_;
  mutable std::span<const ImpulseContact> contacts_;
};

/// ζ, from 0 to 1, of the damper with which a head-on rebound has the restitution e.
double damping_ratio(double restitution);

}  // namespace polhode::collision::contact
