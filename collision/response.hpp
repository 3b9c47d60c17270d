// SPDX-License-Identifier: BSD-3-Clause
// The port of contact response: what happens to the velocities of bodies that meet. One catalogue, interchangeable by
// name.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "collision/contact.hpp"

namespace polhode {

template <class S>
class System;
template <class S>
class ForceModel;
}  // namespace polhode

namespace polhode::inline collision {

class ContactScene;

/// A body as impulses see it, world axes. What cannot move has no inverse mass and no inverse inertia.
struct ImpulseBody {
  Vector3<double> position = Vector3<double>::Zero();          ///< m, of the mass centre, or of the pivot
  Vector3<double> velocity = Vector3<double>::Zero();          ///< m/s, of that point
  Vector3<double> angular_velocity = Vector3<double>::Zero();  ///< rad/s
  double inverse_mass = 0;                                     ///< 1/kg
  Matrix3<double> inverse_inertia = Matrix3<double>::Zero();   ///< 1/(kg m²), world axes, about `position`
  /// What the handling of penetration moves it by, apart from its velocity: m, and rad about `position`.
  Vector3<double> shift = Vector3<double>::Zero(), turn = Vector3<double>::Zero();

  bool moves() const { return inverse_mass > 0 || !inverse_inertia.isZero(0); }
  Vector3<double> velocity_at(const Vector3<double>& point) const {
    return velocity + angular_velocity.cross(point - position);
  }
  /// An impulse at a point of the world: v += j/m, ω += I⁻¹ (r × j).
  void push(const Vector3<double>& point, const Vector3<double>& impulse) {
    velocity += inverse_mass * impulse;
    angular_velocity += inverse_inertia * (point - position).cross(impulse);
  }
};

/// One point where two bodies touch, and the law that they obey there: with v the velocity of A relative to B at the
/// point, j the impulse on A and n from B to A,
///   v'·n >= wanted,   j·n >= 0,   one of them with equality;   |j − (j·n) n| <= friction · j·n, against the slip.
struct ImpulseContact {
  std::uint32_t a = 0, b = 0;                        ///< numbers of the bodies, a < b; contacts come sorted by them
  Vector3<double> normal = Vector3<double>::Zero();  ///< unit, world, from B to A
  Vector3<double> point = Vector3<double>::Zero();   ///< m, world
  double depth = 0;                                  ///< m, negative where they are apart
  double friction = 0;                               ///< Coulomb's
  double restitution = 0;                            ///< 0 for a contact that is too slow to bounce
  double approach = 0;                               ///< m/s, v·n before the impact; restitution reflects it
  double wanted = 0;  ///< m/s: −restitution · approach of an impact, 0 at rest, −gap/h where they may still meet
  Feature feature{};
  Vector3<double> impulse = Vector3<double>::Zero();  ///< N s, on A: the answer
};

class Response {
 public:
  virtual ~Response() = default;

  /// Changes the velocities of the bodies, and says by which impulses. `step` (s) is the length of the step that the
  /// impulses are for, 0 at an instant; where it is not 0, shift and turn say how to undo penetration.
  virtual void resolve(std::span<ImpulseBody> bodies, std::span<ImpulseContact> contacts, double step) = 0;

  /// Forgets the impulses of the step before, from which some start.
  virtual void forget() {}
};

/// What a response by forces needs to know of surfaces, beside restitution and friction.
struct Compliance {
  double stiffness = 0;      ///< N/m, of each point of contact; 0: what the response derives from the masses
  double slip_speed = 1e-3;  ///< m/s: at this slip friction has 1/√2 of what it tends to
};

/// One that answers by impulses has `make`; one that is a force, and leaves all else to the method, has `make_force`.
struct ResponseEntry {
  std::string name;     ///< as in the catalogue: "sequential_impulses"
  std::string summary;  ///< one line of mathematics
  std::unique_ptr<Response> (*make)() = nullptr;
  /// System and scene must outlive it, and nobody else may ask the scene while it lives.
  std::unique_ptr<ForceModel<double>> (*make_force)(const System<double>&, ContactScene&, const Compliance&) = nullptr;
};

/// Those of the catalogue, one line each.
const std::vector<ResponseEntry>& response_catalogue();
const ResponseEntry* find_response(std::string_view name);
/// Those among them that answer by impulses.
std::vector<ResponseEntry> impulse_responses();

}  // namespace polhode
