// SPDX-License-Identifier: BSD-3-Clause
// Contacts and joints together at one instant. Impulses λ of the contacts and μ of the joints make
//   v' = v + M⁻¹ (Jᵀ λ + Gᵀ μ),   G v' = G v,
// with the law of the response between λ and v'. The response resolves the contacts while μ is held; the joints then
// take back what that did to G v; so in turn, until the joints have nothing left to take. Without friction and
// restitution this minimizes the kinetic energy over two blocks of impulses. The gradient in the metric of G M⁻¹ Gᵀ is
// the change of μ; the length of the step along it is that of Barzilai & Borwein, "Two-point step size gradient
// methods", 1988.
#pragma once

#include <vector>

#include "collision/response.hpp"
#include "core/system/system.hpp"

namespace polhode::inline collision::inline contact {

class JointedContacts {
 public:
  /// The system must outlive it.
  explicit JointedContacts(const System<double>& system) : system_(system) {}

  /// Response::resolve() for bodies in the state y, with the joints of the system. Displacements that undo penetration
  /// keep the joints closed to first order. Restitution must not add energy: impulses are moved towards those without
  /// restitution as far as that takes. Where joints leave no velocities with it, contacts do not bounce.
  void resolve(Response& response, const VectorX<double>& y, std::span<ImpulseBody> bodies,
               std::span<ImpulseContact> contacts, double step);

  /// Starts from no impulses of the joints, in place of those of the step before.
  void forget();

 private:
  bool find_impulses(Response& response, std::span<ImpulseBody> bodies, std::span<ImpulseContact> contacts,
                     double step);
  void limit_energy(Response& response, std::span<ImpulseBody> bodies, std::span<ImpulseContact> contacts, double step,
                    bool found);
  void spread(const VectorX<double>& impulses);
  double close();
  void close_shifts(std::span<ImpulseBody> bodies);

  const System<double>& system_;
  std::vector<BodyMotion<double>> motions_;
  std::vector<ImpulseBody> free_, bouncing_;  ///< bodies before the impulses; bodies after impulses with restitution
  std::vector<Vector3<double>> of_contacts_;
  std::vector<Wrench<double>> twists_, change_;  ///< changes of the velocities: m/s, rad/s
  VectorX<double> impulses_;                     ///< μ, N s or N m s
  VectorX<double> right_, multipliers_, before_;
};

}  // namespace polhode::collision::contact
