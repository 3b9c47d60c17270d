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
#include "collision/contact/contact_scene.hpp"
#include "collision/contact/guards.hpp"
#include "core/run/contact_model.hpp"

namespace polhode {

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
    double length = 0;    ///< s
    bool impact = false;  ///< ends where two bodies meet
  };

  /// A contact that slides where a hold begins.
  struct Slide {
    std::size_t contact;    ///< its number among those that rest
    double slip;            ///< m/s
    Vector3<double> along;  ///< unit: its direction
    double mobility;        ///< 1/kg: how fast it gives way along that
  };

  std::span<ImpulseContact> touching(const State<double>& state);
  bool take_impacts(Integrator<double>& method, State<double>& state);
  bool hold_resting(Integrator<double>& method, const State<double>& state, double h);
  bool resolve_hold(Integrator<double>& method, const State<double>& state, double h);
  double first_transition(Integrator<double>& method, const State<double>& state, double h);
  double slip_left(std::span<const Slide> pair) const;
  template <class F>
  void for_sliding_pairs(const F& f) const;
  double least_slip_left() const;
  bool stops(std::span<const Slide> pair) const;
  bool some_stop() const;
  void note_transitions(double t);
  void note_stuck();
  void measure_accelerations(const State<double>& state);
  double normal_acceleration(const ImpulseContact& c) const;
  double slow(const ImpulseContact& c) const;
  StepResult fly(Integrator<double>& method, State<double>& state, double h, Flight& flight);
  void foresee(const State<double>& state, double h);
  void watch(const State<double>& from, const State<double>& to);
  bool go_to(Integrator<double>& method, const State<double>& start, double s, State<double>& there);
  double first_below(Integrator<double>& method, const State<double>& start, double from, const Guards::Look& at_from,
                     double to, const Guards::Look& at_to, int depth);
  void account_held(const State<double>& end);

  System<double>& system_;
  ContactScene& scene_;
  std::unique_ptr<Response> response_;
  HeldImpulses* held_;
  ContactLosses losses_;
  std::vector<Impact> impacts_;
  std::vector<Transition> transitions_;
  ContactLengths lengths_;
  Guards guards_;
  std::vector<Guards::Look> looks_;  ///< of each halving of a flight, and of its ends
  bool no_bounce_ = false;           ///< the impacts at this instant were tried, and did not lead apart
  bool all_rest_ = false;            ///< what touches did not come apart in the flight before
  bool sinking_ = false;             ///< a held pair reached its allowance, and it was no impact
  bool one_step_ = true;             ///< the flight is a step of the method, not several that hold contacts
  bool searched_ = false;            ///< the method was stepped elsewhere than along the flight
  std::vector<Pose> poses_;
  std::vector<ImpulseBody> bodies_, later_, end_;
  std::vector<ImpulseContact> resting_, rested_;  ///< held now, and in the flight before
  std::vector<Slide> slides_;
  std::vector<BodyPair> stuck_;  ///< at the end of the last hold; sorted
  std::vector<double> rests_from_;
  VectorX<double> rate_;
  State<double> free_, start_, there_, whole_start_, before_impacts_;
  double whole_ = 0;  ///< s, of the flight that is searched
};

}  // namespace polhode
