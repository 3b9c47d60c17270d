// SPDX-License-Identifier: BSD-3-Clause
// The port of contact response: changes the velocities of bodies in contact.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "collision/contact.hpp"

namespace polhode::inline core {
inline namespace system {
template <class S>
class System;
}
inline namespace problem {
template <class S>
class ForceModel;
}
}  // namespace polhode::core

namespace polhode::inline collision {

inline namespace contact {
class ContactScene;
}

/// Position, motion and inverse mass of a body, as responses use them, world axes. A static body has zero inverse mass
/// and zero inverse inertia.
struct ImpulseBody {
  Vector3<double> position = Vector3<double>::Zero();  ///< position of the mass centre, or of a pinned body's pivot, m
  Vector3<double> velocity = Vector3<double>::Zero();  ///< velocity of that point, m/s
  Vector3<double> angular_velocity = Vector3<double>::Zero();  ///< rad/s
  double inverse_mass = 0;                                     ///< 1/kg
  Matrix3<double> inverse_inertia = Matrix3<double>::Zero();   ///< 1/(kg m²), world axes, about `position`
  /// Displacement (m) and rotation vector (rad, about `position`) that undo penetration; the velocities are not
  /// affected.
  Vector3<double> shift = Vector3<double>::Zero(), turn = Vector3<double>::Zero();

  bool moves() const { return inverse_mass > 0 || !inverse_inertia.isZero(0); }
  Vector3<double> velocity_at(const Vector3<double>& point) const {
    return velocity + angular_velocity.cross(point - position);
  }
  /// Applies an impulse at a point of the world: v += j/m, ω += I⁻¹ (r × j).
  void push(const Vector3<double>& point, const Vector3<double>& impulse) {
    velocity += inverse_mass * impulse;
    angular_velocity += inverse_inertia * (point - position).cross(impulse);
  }
};

/// One contact point and its law. With v the velocity of A relative to B at the point, j the impulse on A and n the
/// normal from B to A:
///   v'·n >= wanted,   j·n >= 0,   one of them with equality;   |j − (j·n) n| <= friction · j·n, against the slip.
struct ImpulseContact {
  std::uint32_t a = 0, b = 0;                        ///< numbers of the bodies, a < b; contacts are sorted by them
  Vector3<double> normal = Vector3<double>::Zero();  ///< unit normal from B to A, world axes
  Vector3<double> point = Vector3<double>::Zero();   ///< position of the point, world axes, m
  double depth = 0;                                  ///< depth, negative if the surfaces are apart, m
  double friction = 0;                               ///< Coulomb's coefficient
  double restitution = 0;                            ///< Newton's restitution; 0 for a contact too slow to bounce
  double approach = 0;  ///< normal velocity v·n before the impact, m/s; restitution reflects it
  double wanted = 0;  ///< lower bound of v'·n, m/s: −restitution · approach in an impact, 0 at rest, −gap/h if the
                      ///< surfaces may still meet within the step h
  Feature feature{};
  Vector3<double> impulse = Vector3<double>::Zero();  ///< impulse on A: the result, N s
};

class Response {
 public:
  virtual ~Response() = default;

  /// Changes the velocities of the bodies and stores the impulses in the contacts. `step` (s): length of the step in
  /// which the impulses act; 0: an impact at an instant. If it is positive, shift and turn are set so as to undo
  /// penetration.
  virtual void resolve(std::span<ImpulseBody> bodies, std::span<ImpulseContact> contacts, double step) = 0;

  /// Clears the impulses of the previous step that serve as a warm start.
  virtual void forget() {}
};

/// Parameters of a response by forces, besides restitution and friction.
struct Compliance {
  double stiffness = 0;      ///< stiffness of one contact point, N/m; 0: derived from the masses
  double slip_speed = 1e-3;  ///< slip speed at which friction is 1/√2 of its limit, m/s
};

/// A response by impulses has `make`. A response by a force, which every method integrates, has `make_force`.
struct ResponseEntry {
  std::string name;     ///< name in the catalogue: "sequential_impulses"
  std::string summary;  ///< one line of mathematics
  std::unique_ptr<Response> (*make)() = nullptr;
  /// System and scene must outlive the force. Nobody else may query the scene during its lifetime.
  std::unique_ptr<ForceModel<double>> (*make_force)(const System<double>&, ContactScene&, const Compliance&) = nullptr;
};

inline namespace response {
/// All responses.
const std::vector<ResponseEntry>& response_catalogue();
const ResponseEntry* find_response(std::string_view name);
/// The responses by impulses.
std::vector<ResponseEntry> impulse_responses();
}  // namespace response

}  // namespace polhode::collision
