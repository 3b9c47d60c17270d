// SPDX-License-Identifier: BSD-3-Clause
#include "collision/contact/event_located.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/contact/contact_losses.hpp"

namespace polhode::inline collision::inline contact {
namespace {

constexpr double resting_step = 1e-3;  // longest hold of resting contacts with an adaptive method, s
constexpr int most_impacts = 1000;     // limit of impacts in one step

ConstantContactForces* add_contact_forces(System<double>& system, const ContactScene& scene) {
  auto forces = std::make_unique<ConstantContactForces>(scene.all_free());
  ConstantContactForces* added = forces.get();
  system.add_force(std::move(forces));
  return added;
}

}  // namespace

EventLocated::EventLocated(System<double>& system, ContactScene& scene, std::unique_ptr<Response> response)
    : system_(system),
      response_(std::move(response)),
      contact_forces_(add_contact_forces(system, scene)),
      lengths_(scene),
      guards_(system, scene),
      kinematics_(system, scene, lengths_),
      resting_(system, *response_, *contact_forces_, lengths_),
      search_(guards_, lengths_) {}

void EventLocated::begin(Integrator<double>& method, const State<double>& state) {
  response_->forget();
  contact_forces_->release();
  losses_ = {};
  impacts_.clear();
  transitions_.clear();
  resting_.begin();
  rate_ = VectorX<double>::Zero(state.y.size());
  guards_.clear();
  if (NativeRoots<double>* roots = method.native_roots()) {
    roots->set_events({[this](const State<double>& seen) { return guards_.least(seen); }});
  }
}

/// The contact points where surfaces touch. Removes all guards, because their indices refer to the list of near pairs,
/// which this call replaces.
std::span<ImpulseContact> EventLocated::touching(const State<double>& state) {
  guards_.clear();
  return kinematics_.touching(state);
}

/// Resolves all impacts at this instant together. True if there was one.
bool EventLocated::take_impacts(Integrator<double>& method, State<double>& state) {
  std::span<ImpulseContact> contacts = touching(state);
  if (contacts.empty()) return false;
  kinematics_.measure_accelerations(state);
  // Skip contacts that are still apart and not at rest. Resting contacts take part in an impact.
  const auto apart = [&](const ImpulseContact& c) {
    return c.depth < -lengths_.met && std::abs(c.approach) > kinematics_.resting_speed(c);
  };
  contacts = contacts.first(std::size_t(std::remove_if(contacts.begin(), contacts.end(), apart) - contacts.begin()));
  bool any = false;
  rests_from_.assign(contacts.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    ImpulseContact& c = contacts[k];
    const double limit = kinematics_.resting_speed(c), bounce = -c.approach * c.restitution;
    any = any || c.approach < -limit;
    if (bounce <= limit || !phase_.restitution()) {
      // The following bounces are too low to be simulated. Their total duration is the geometric series Σ 2 v eⁿ / a.
      const double pull = -kinematics_.normal_acceleration(c);
      if (bounce > 0 && pull > 0 && c.restitution < 1)
        rests_from_[k] = state.t + 2 * bounce / pull / (1 - c.restitution);
      c.restitution = 0;
    }
    c.wanted = -c.restitution * std::min(c.approach, 0.0);
  }
  if (!any) return false;
  const std::vector<ImpulseBody>& bodies = kinematics_.bodies();
  after_impacts_ = bodies;
  response_->forget();
  response_->resolve(after_impacts_, contacts, 0);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const ImpulseContact& c = contacts[k];
    if (c.impulse.isZero(0)) continue;
    const double lost = book(c, bodies, after_impacts_, losses_);
    impacts_.push_back({state.t, c.a, c.b, c.point, c.normal, c.impulse, lost, rests_from_[k]});
    const auto push = [&](std::uint32_t i, const Vector3<double>& j) {
      if (i < system_.moving()) system_.apply_impulse(state.y, i, j, (c.point - bodies[i].position).cross(j));
    };
    push(c.a, c.impulse);
    push(c.b, -c.impulse);
  }
  method.discard_history(state);
  return true;
}

/// Sets guards for native event location, before the step. The state after h (s) is extrapolated linearly.
void EventLocated::watch_ahead(const State<double>& state, double h, double deeper) {
  system_.rate(state.t, state.y.data(), rate_.data());
  ahead_ = state;
  ahead_.t += h;
  ahead_.y += h * rate_;
  guards_.watch(state, ahead_, resting_.contacts(), deeper);
}

/// Advances `state` by at most h (s), or to the first impact if there is one. `sinks`: a held pair has
/// reached its allowed penetration.
StepResult EventLocated::fly(Integrator<double>& method, State<double>& state, double h, bool sinks, Flight& flight) {
  const double deeper = sinks ? lengths_.allowed_penetration : 0.01 * lengths_.minimum_bounce_height;
  start_ = state;
  if (method.native_roots()) watch_ahead(state, h, deeper);
  const bool one_step = resting_.contacts().empty();
  StepResult result = one_step ? method.step(state, h) : advance(method, state, h);
  if (!result.ok()) {
    state = start_;
    return result;
  }
  flight = {state.t - start_.t, false};
  guards_.watch(start_, state, resting_.contacts(), deeper);
  if (guards_.empty()) return result;
  FlightPath path(method, start_, one_step);
  const std::optional<double> impact = search_.first_impact(path, start_, state, flight.length);
  if (!impact) {
    if (path.stepped_method()) method.discard_history(state);
    return result;
  }
  flight = {*impact, true};
  if (*impact == 0) {
    state = start_;
    method.discard_history(state);
    return result;
  }
  const bool reached = path.state_at(*impact, at_impact_);
  state = reached ? at_impact_ : start_;
  return reached ? result : StepResult{"the state at an impact could not be reached"};
}

StepResult EventLocated::step(Integrator<double>& method, State<double>& state, double h) {
  impacts_.clear();
  transitions_.clear();
  phase_.begin_step();
  step_start_ = state;
  const ContactLosses losses_before = losses_;
  const auto failed = [&](StepResult result) {
    state = step_start_;
    losses_ = losses_before;
    impacts_.clear();
    transitions_.clear();
    return result;
  };
  const double target = state.t + h;
  // True if the method, being adaptive, ended its step before the target time.
  bool adaptive = false;
  for (int count = 0;; ++count) {
    if (count > most_impacts) {
      return failed({"more than " + std::to_string(most_impacts) +
                     " impacts in one step; take --impact-timing time_stepping, or a response that answers all points "
                     "of a face at once"});
    }
    before_impacts_ = state;
    const ContactLosses losses_before_impacts = losses_;
    const std::size_t impacts_before = impacts_.size(), transitions_before = transitions_.size();
    const bool met = take_impacts(method, state);
    double left = target - state.t;
    if (!(left > 0)) break;

    const double longest = method.dense_output() ? std::min(left, resting_step) : left;
    const bool held = resting_.hold(method, state, longest, touching(state), kinematics_, phase_.holds_all());
    const bool until_transition = held && resting_.length() < longest;
    if (held) left = resting_.length();
    if (until_transition) resting_.note_transitions(state.t + left, transitions_);

    Flight flight;
    const StepResult result = fly(method, state, left, phase_.sinks(met), flight);
    if (held) resting_.account(start_, state, losses_, transitions_);
    contact_forces_->release();
    if (!result.ok()) return failed(result);
    if (flight.impact || held) method.discard_history(state);

    if (flight.impact) {
      transitions_.resize(transitions_before);  // the flight ended before these transitions
      resting_.impact();
      if (flight.length > 0) {
        phase_.impact_found();
      } else if (!met) {
        phase_.contact_persists();
      } else {  // undo the impacts and resolve them again without a bounce
        phase_.bounce_failed();
        state = before_impacts_;
        losses_ = losses_before_impacts;
        impacts_.resize(impacts_before);
        method.discard_history(state);
      }
      continue;
    }
    phase_.completed();
    if (until_transition && state.t < target) continue;
    adaptive = state.t < target;
    if (adaptive || flight.length >= left) break;
  }
  if (!adaptive) state.t = target;
  return {};
}

}  // namespace polhode::collision::contact
