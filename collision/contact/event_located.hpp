// SPDX-License-Identifier: BSD-3-Clause
// Contact as events: between impacts the bodies fly as the method makes them, and an impact is found where a signed
// distance crosses zero. A method with roots of its own (CVODE) finds it by these, one with dense output on that, any
// other by a bracketing search over re-taken steps (TOMS 748: Alefeld, Potra & Shi, Algorithm 748, 1995). So the flight
// keeps the order of the method, and the error of an event's time falls with it.
//
// Policies. Several impacts at one instant go to the response together. A distance that may have dipped below zero
// between two instants, by the bounds of guards.hpp, is looked at between them, until the dip is shorter than 1e-6 of
// the step. A bounce that would rise by less than a hop, 1e-11 of the largest body, or that the method is too
// inaccurate to tell from rest, is not flown: the contact rests (Zeno). A contact that rests is held through the step
// by the impulses that the response asks for, as in time stepping, but no longer than it slides: the end of a pair's
// slide is found by the same search, over re-taken holds, where the slip that is left crosses zero. A pair that is held
// may sink by 1e-7 of the largest body before it is looked at again. After 1000 impacts in one step the run fails and
// says so: it never hangs. So it ends with single_impulse where a body settles on a face: with one impulse for a pair
// it rocks from side to side, ever faster, and no point of it rests before the others.
#pragma once

#include "collision/contact/constant_contact_forces.hpp"
#include "collision/contact/contact_kinematics.hpp"
#include "collision/contact/contact_scene.hpp"
#include "collision/contact/flight_phase.hpp"
#include "collision/contact/guards.hpp"
#include "collision/contact/impact_search.hpp"
#include "collision/contact/resting_contacts.hpp"
#include "core/run/contact_model.hpp"

namespace polhode::inline collision {

class EventLocated final : public ContactModel {
 public:
  /// Registers the held impulses with the system as a force. All must outlive it but the response.
  EventLocated(System<double>& system, ContactScene& scene, std::unique_ptr<Response> response);

  void begin(Integrator<double>& method, const State<double>& state) override;
  StepResult step(Integrator<double>& method, State<double>& state, double h) override;
  const ContactLosses& losses() const override { return losses_; }
  std::span<const Impact> impacts() const override { return impacts_; }
  std::span<const Transition> transitions() const override { return transitions_; }

 private:
  struct Flight {
    double length = 0;    ///< duration, s
    bool impact = false;  ///< true: the flight ends with an impact
  };

  std::span<ImpulseContact> touching(const State<double>& state);
  bool take_impacts(Integrator<double>& method, State<double>& state);
  StepResult fly(Integrator<double>& method, State<double>& state, double h, bool sinks, Flight& flight);
  void watch_ahead(const State<double>& state, double h, double deeper);

  System<double>& system_;
  std::unique_ptr<Response> response_;
  ConstantContactForces* contact_forces_;
  ContactLosses losses_;
  std::vector<Impact> impacts_;
  std::vector<Transition> transitions_;
  ContactLengths lengths_;
  Guards guards_;
  ContactKinematics kinematics_;
  RestingContacts resting_;
  ImpactSearch search_;
  FlightPhase phase_;
  std::vector<ImpulseBody> after_impacts_;
  std::vector<double> rests_from_;
  VectorX<double> rate_;
  State<double> ahead_, start_, at_impact_, step_start_, before_impacts_;
};

}  // namespace polhode
