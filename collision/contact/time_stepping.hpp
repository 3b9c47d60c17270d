// SPDX-License-Identifier: BSD-3-Clause
// Contact at the step: no impact is looked for within it. The method takes the step once without contact; the response
// says which impulses its end velocities need to obey the contacts where the step begins; and the method takes the step
// again with these impulses held as forces. With semi-implicit Euler that is the scheme of game engines (Stewart &
// Trinkle, An implicit time-stepping scheme for rigid body dynamics, 1996; Catto, Iterative dynamics with temporal
// coherence, 2005), digit for digit but for the order of sums.
#pragma once

#include "collision/contact/constant_contact_forces.hpp"
#include "collision/contact/contact_scene.hpp"
#include "core/run/contact_model.hpp"

namespace polhode::inline collision {

/// Which velocity restitution reflects: that at the start of the step, or that which its end would have without
/// contact. A bouncing ball keeps the modified energy of semi-implicit Euler with the first; the second adds a step of
/// gravity.
enum class Reflected { at_start, at_free_end };

class TimeStepping final : public ContactModel {
 public:
  /// Registers the held impulses with the system as a force. All must outlive it but the response.
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
  Reflected reflected_;
  ConstantContactForces* contact_forces_;
  ContactLosses losses_;
  std::vector<Impact> impacts_;
  std::vector<Pose> poses_;
  std::vector<ImpulseBody> bodies_, start_, end_;
  std::vector<double> reach_;  ///< m, of each body: how far it may come in the step
  State<double> free_, before_;
};

}  // namespace polhode
