// SPDX-License-Identifier: BSD-3-Clause
// Contact at the start of a step; impacts within the step are not located. The method takes the step once without
// contact. The response computes the impulses with which its final velocities obey the contacts found at the start of
// the step. The method then takes the step again with these impulses as constant forces. With semi-implicit Euler this
// is the scheme of game engines (Stewart & Trinkle, An implicit time-stepping scheme for rigid body dynamics, 1996;
// Catto, Iterative dynamics with temporal coherence, 2005), with the same digits up to the order of sums.
#pragma once

#include "collision/contact/constant_contact_forces.hpp"
#include "collision/contact/contact_scene.hpp"
#include "collision/contact/jointed_contacts.hpp"
#include "core/run/contact_model.hpp"

namespace polhode::inline collision::inline contact {

/// The velocity that restitution reflects: the velocity at the start of the step, or the velocity that the step would
/// end with without contact. With the first, a bouncing ball conserves the modified energy of semi-implicit Euler; the
/// second adds one step of gravity.
enum class Reflected { at_start, at_free_end };

class TimeStepping final : public ContactModel {
 public:
  /// Registers the constant contact forces with the system. System and scene must outlive it.
  TimeStepping(System<double>& system, ContactScene& scene, std::unique_ptr<Response> response,
               Reflected reflected = Reflected::at_start);

  void begin(Integrator<double>& method, const State<double>& state) override;
  StepResult step(Integrator<double>& method, State<double>& state, double h) override;
  const ContactLosses& losses() const override { return losses_; }
  std::span<const Impact> impacts() const override { return impacts_; }

 private:
  std::span<ImpulseContact> find_contacts(const State<double>& start, double h);
  void account(const State<double>& end, std::span<const ImpulseContact> contacts);
  void undo_penetration(State<double>& state);

  System<double>& system_;
  ContactScene& scene_;
  std::unique_ptr<Response> response_;
  JointedContacts joined_;
  Reflected reflected_;
  ConstantContactForces* contact_forces_;
  ContactLosses losses_;
  std::vector<Impact> impacts_;
  std::vector<Pose> poses_;
  std::vector<ImpulseBody> bodies_, start_, end_;
  std::vector<double> reach_;  ///< largest distance that each body may move in the step, m
  State<double> free_, before_;
};

}  // namespace polhode::collision::contact
