// SPDX-License-Identifier: BSD-3-Clause
#include "collision/contact/event_located.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

#include "collision/contact/contact_losses.hpp"
#include "collision/response/contact_frame.hpp"

namespace polhode {
namespace {

constexpr double quiet = 1e-11;              // m/s, of round-off in a contact that rests
constexpr double resting_step = 1e-3;        // s, at most, through which a method that chooses its steps holds contacts
constexpr int most_impacts = 1000;           // in a step
constexpr int most_inner_steps = 1'000'000;  // of a method that chooses its steps, in one of them
constexpr int deepest_search = 20;           // halvings of a flight: a dip shorter than 1e-6 of it is not seen
constexpr double brief = 1e-6;               // of a hold: a slide that ends sooner is none

/// As many steps as it takes to go on by h.
StepResult advance(Integrator<double>& method, State<double>& state, double h) {
  const double end = state.t + h;
  StepResult result;
  int count = 0;
  do {
    if (++count > most_inner_steps) return {"the method takes a million steps in one; take a larger tolerance"};
    result = method.step(state, end - state.t);
  } while (result.ok() && end - state.t > 1e-12 * h);
  if (result.ok()) state.t = end;
  return result;
}

double normal_speed(const std::vector<ImpulseBody>& bodies, const ImpulseContact& c) {
  return (bodies[c.a].velocity_at(c.point) - bodies[c.b].velocity_at(c.point)).dot(c.normal);
}

Vector3<double> slip_of(const std::vector<ImpulseBody>& bodies, const ImpulseContact& c) {
  const Vector3<double> v = bodies[c.a].velocity_at(c.point) - bodies[c.b].velocity_at(c.point);
  return v - v.dot(c.normal) * c.normal;
}

}  // namespace

EventLocated::EventLocated(System<double>& system, ContactScene& scene, std::unique_ptr<Response> response)
    : system_(system), scene_(scene), response_(std::move(response)), lengths_(scene), guards_(system, scene) {
  auto held = std::make_unique<HeldImpulses>(scene.all_free());
  held_ = held.get();
  system.add_force(std::move(held));
  looks_.resize(deepest_search + 4);
}

void EventLocated::begin(Integrator<double>& method, const State<double>& state) {
  response_->forget();
  held_->release();
  losses_ = {};
  impacts_.clear();
  transitions_.clear();
  stuck_.clear();
  rate_ = VectorX<double>::Zero(state.y.size());
  guards_.clear();
  if (method.has_native_roots()) {
    method.set_events({[this](const State<double>& seen) { return guards_.least(seen); }});
  }
}

/// The contact points where surfaces touch, with the speed at which they approach.
std::span<ImpulseContact> EventLocated::touching(const State<double>& state) {
  shape_poses(system_, state.y, poses_);
  guards_.clear();  // they are numbered as the near pairs are
  scene_.near_pairs(poses_, poses_, {}, lengths_.touch + lengths_.sink);
  impulse_bodies(system_, state.y, bodies_);
  const std::span<ImpulseContact> all = scene_.contacts(poses_, lengths_.touch + lengths_.sink);
  for (ImpulseContact& c : all) c.approach = normal_speed(bodies_, c);
  return all;
}

/// How the velocities change without contact: a short way along the ODE.
void EventLocated::measure_accelerations(const State<double>& state) {
  held_->release();
  system_.rate(state.t, state.y.data(), rate_.data());
  const double fast = rate_.cwiseAbs().maxCoeff();
  const double dt = fast > 0 ? 1e-7 / std::max(1.0, fast) : 1e-7;
  there_.y = state.y + dt * rate_;
  impulse_bodies(system_, there_.y, later_);
  for (std::size_t i = 0; i < later_.size(); ++i) {
    later_[i].velocity = (later_[i].velocity - bodies_[i].velocity) / dt;
    later_[i].angular_velocity = (later_[i].angular_velocity - bodies_[i].angular_velocity) / dt;
  }
}

/// Of the two bodies' points at the contact, as they move with them.
double EventLocated::normal_acceleration(const ImpulseContact& c) const {
  const auto of = [&](std::uint32_t i) -> Vector3<double> {
    const Vector3<double> arm = c.point - bodies_[i].position, &w = bodies_[i].angular_velocity;
    return later_[i].velocity + later_[i].angular_velocity.cross(arm) + w.cross(w.cross(arm));
  };
  return (of(c.a) - of(c.b)).dot(c.normal);
}

/// m/s: a contact that is pressed together and no faster neither is an impact nor comes apart by more than a hop.
double EventLocated::slow(const ImpulseContact& c) const {
  return quiet + std::sqrt(2 * lengths_.hop * std::max(-normal_acceleration(c), 0.0));
}

/// Impacts at this instant, all together. True if there was one.
bool EventLocated::take_impacts(Integrator<double>& method, State<double>& state) {
  std::span<ImpulseContact> contacts = touching(state);
  if (contacts.empty()) return false;
  measure_accelerations(state);
  // What still approaches is left to fly; what rests takes its part in an impact.
  const auto apart = [&](const ImpulseContact& c) { return c.depth < -lengths_.met && std::abs(c.approach) > slow(c); };
  contacts = contacts.first(std::size_t(std::remove_if(contacts.begin(), contacts.end(), apart) - contacts.begin()));
  bool any = false;
  rests_from_.assign(contacts.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    ImpulseContact& c = contacts[k];
    const double limit = slow(c), bounce = -c.approach * c.restitution;
    any = any || c.approach < -limit;
    if (bounce <= limit || no_bounce_) {  // its flight would be too low: the series of 2 v eⁿ / a, all at once
      const double pull = -normal_acceleration(c);
      if (bounce > 0 && pull > 0 && c.restitution < 1)
        rests_from_[k] = state.t + 2 * bounce / pull / (1 - c.restitution);
      c.restitution = 0;
    }
    c.wanted = -c.restitution * std::min(c.approach, 0.0);
  }
  if (!any) return false;
  end_ = bodies_;
  response_->forget();
  response_->resolve(end_, contacts, 0);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const ImpulseContact& c = contacts[k];
    if (c.impulse.isZero(0)) continue;
    const double lost = book(c, bodies_, end_, losses_);
    impacts_.push_back({state.t, c.a, c.b, c.point, c.normal, c.impulse, lost, rests_from_[k]});
    const auto push = [&](std::uint32_t i, const Vector3<double>& j) {
      if (i < system_.moving()) system_.apply_impulse(state.y, i, j, (c.point - bodies_[i].position).cross(j));
    };
    push(c.a, c.impulse);
    push(c.b, -c.impulse);
  }
  method.discard_history(state);
  return true;
}

/// Holds the contacts that rest or slide through the next h seconds; false where there is none.
bool EventLocated::hold_resting(Integrator<double>& method, const State<double>& state, double h) {
  const std::span<ImpulseContact> contacts = touching(state);
  std::swap(resting_, rested_);
  resting_.clear();
  if (contacts.empty()) return false;
  measure_accelerations(state);
  for (ImpulseContact& c : contacts) {
    // A low flight is slow at its apex: only a contact that rested before may be so far apart.
    const auto same_pair = [&](const ImpulseContact& r) { return r.a == c.a && r.b == c.b; };
    const bool rested = std::any_of(rested_.begin(), rested_.end(), same_pair);
    if (!all_rest_ && (std::abs(c.approach) > slow(c) || (!rested && c.depth < -lengths_.hop))) continue;
    c.restitution = 0;
    c.wanted = 0;
    resting_.push_back(c);
  }
  if (resting_.empty()) return false;
  if (!resolve_hold(method, state, h)) return false;
  whole_ = first_transition(method, state, h);
  if (!(whole_ > 0)) return false;
  if (whole_ < h) note_transitions(state.t + whole_);
  note_stuck();
  held_->hold(resting_, bodies_, whole_);
  all_rest_ = false;
  return true;
}

/// The impulses that hold the contacts that rest through the next h seconds.
bool EventLocated::resolve_hold(Integrator<double>& method, const State<double>& state, double h) {
  free_ = state;
  const bool done = advance(method, free_, h).ok();
  method.discard_history(state);
  if (!done) return false;
  end_ = bodies_;
  impulse_bodies(system_, free_.y, later_);
  for (std::size_t i = 0; i < end_.size(); ++i) {
    end_[i].velocity = later_[i].velocity;
    end_[i].angular_velocity = later_[i].angular_velocity;
  }
  response_->forget();
  response_->resolve(end_, resting_, 0);
  return true;
}

/// m/s: of a pair that slides at first, how far it is from ceasing to in the hold that was resolved last. While a point
/// of it slides on, the fastest slip along what it was; else less than zero, by what friction has to spare.
double EventLocated::slip_left(std::span<const Slide> pair) const {
  double fastest = -std::numeric_limits<double>::infinity(), spare = 0;
  for (const Slide& s : pair) {
    const ImpulseContact& c = resting_[s.contact];
    const Vector3<double> slip = slip_of(end_, c);
    if (slip.norm() > brief * s.slip) fastest = std::max(fastest, slip.dot(s.along));
    spare += s.mobility * (c.friction * c.impulse.dot(c.normal) + c.impulse.dot(s.along));
  }
  return std::isfinite(fastest) ? fastest : -spare;
}

/// Calls f with the slides of each pair.
template <class F>
void EventLocated::for_sliding_pairs(const F& f) const {
  const std::span<const Slide> all(slides_);
  for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
    const auto same = [&](std::size_t k) {
      const ImpulseContact &c = resting_[all[first].contact], &d = resting_[all[k].contact];
      return c.a == d.a && c.b == d.b;
    };
    while (last < all.size() && same(last)) ++last;
    f(all.subspan(first, last - first));
  }
}

double EventLocated::least_slip_left() const {
  double least = std::numeric_limits<double>::infinity();
  for_sliding_pairs([&](std::span<const Slide> pair) { least = std::min(least, slip_left(pair)); });
  return least;
}

/// s: when in a hold of h, which was resolved, the first of the pairs that slide ceases to; h where none does. Resolves
/// the hold until then; 0 where the method fails.
double EventLocated::first_transition(Integrator<double>& method, const State<double>& state, double h) {
  slides_.clear();
  for (std::size_t k = 0; k < resting_.size(); ++k) {
    const ImpulseContact& c = resting_[k];
    if (c.friction == 0) continue;  // it never sticks
    if (std::binary_search(stuck_.begin(), stuck_.end(), BodyPair{c.a, c.b}))
      continue;  // its slip is the method's error
    const Vector3<double> slip = slip_of(bodies_, c);
    Slide s{k, slip.norm(), slip.stableNormalized(), 0};
    s.mobility = s.along.dot(mobility_along(bodies_[c.a], bodies_[c.b], c.point, s.along));
    if (!(s.slip > quiet + brief * s.mobility * c.friction * c.impulse.dot(c.normal))) continue;
    slides_.push_back(s);
  }
  if (slides_.empty()) return h;
  double slip_at_start = std::numeric_limits<double>::infinity();
  for_sliding_pairs([&](std::span<const Slide> pair) {
    double fastest = 0;
    for (const Slide& s : pair) fastest = std::max(fastest, s.slip);
    slip_at_start = std::min(slip_at_start, fastest);
  });
  const double left = least_slip_left();
  if (!(left < 0)) return h;
  const auto value = [&](double s) {
    return resolve_hold(method, state, s) ? least_slip_left() : std::numeric_limits<double>::quiet_NaN();
  };
  const auto close = [&](double low, double high) { return high - low <= 0.1 * brief * h; };
  std::uintmax_t rounds = 40;
  const double end = boost::math::tools::toms748_solve(value, 0.0, h, slip_at_start, left, close, rounds).second;
  if (end > brief * h && end < h && resolve_hold(method, state, end) && some_stop()) return end;
  return resolve_hold(method, state, h) ? h : 0;  // a slip that turned
}

/// Whether a pair that slid at first has no slip at the end of the hold.
bool EventLocated::stops(std::span<const Slide> pair) const {
  return std::all_of(pair.begin(), pair.end(), [&](const Slide& s) {
    return slip_of(end_, resting_[s.contact]).norm() <= quiet + brief * s.slip;
  });
}

bool EventLocated::some_stop() const {
  bool some = false;
  for_sliding_pairs([&](std::span<const Slide> pair) { some = some || stops(pair); });
  return some;
}

/// The pairs that cease to slide where the hold ends, at t.
void EventLocated::note_transitions(double t) {
  for_sliding_pairs([&](std::span<const Slide> pair) {
    if (!stops(pair)) return;
    const ImpulseContact& c = resting_[pair.front().contact];
    transitions_.push_back({t, c.a, c.b, c.point, c.normal});
  });
}

/// The pairs that stick or roll at the end of the hold.
void EventLocated::note_stuck() {
  stuck_.clear();
  for (std::size_t k = 0; k < resting_.size();) {
    const std::size_t first = k;
    bool sticks = true;
    for (; k < resting_.size() && resting_[k].a == resting_[first].a && resting_[k].b == resting_[first].b; ++k) {
      const ImpulseContact& c = resting_[k];
      const double could =
          (bodies_[c.a].inverse_mass + bodies_[c.b].inverse_mass) * c.friction * c.impulse.dot(c.normal);
      sticks = sticks && slip_of(end_, c).norm() <= quiet + brief * (slip_of(bodies_, c).norm() + could);
    }
    if (sticks) stuck_.push_back({resting_[first].a, resting_[first].b});
  }
}

/// Which pairs may meet on the way.
void EventLocated::watch(const State<double>& from, const State<double>& to) {
  guards_.watch(from, to, resting_, sinking_ ? lengths_.sink : 0.01 * lengths_.hop);
}

/// Guards for roots of the method's own, before it has taken its step: as if the bodies went straight on.
void EventLocated::foresee(const State<double>& state, double h) {
  system_.rate(state.t, state.y.data(), rate_.data());
  free_ = state;
  free_.t += h;
  free_.y += h * rate_;
  watch(state, free_);
}

/// The state s seconds into the flight: by dense output of the flight's step, or by a step of its own.
bool EventLocated::go_to(Integrator<double>& method, const State<double>& start, double s, State<double>& there) {
  there = start;
  if (one_step_ && method.has_dense_output()) return method.interpolate(start.t + s, there);
  searched_ = true;
  method.discard_history(there);
  return advance(method, there, s).ok();
}

/// The first instant in (from, to] at which the least guard is not positive; infinity if there is none.
double EventLocated::first_below(Integrator<double>& method, const State<double>& start, double from,
                                 const Guards::Look& at_from, double to, const Guards::Look& at_to, int depth) {
  Guards::Look& seen = looks_[std::size_t(depth)];
  const auto value = [&](double s) {
    return go_to(method, start, s, there_) ? guards_.least(there_) : std::numeric_limits<double>::quiet_NaN();
  };
  if (at_from.least > 0 && at_to.least <= 0) {
    double root = to;
    if (at_to.least < 0) {
      std::uintmax_t rounds = 100;
      const auto bracket = boost::math::tools::toms748_solve(value, from, to, at_from.least, at_to.least,
                                                             boost::math::tools::eps_tolerance<double>(52), rounds);
      root = bracket.second;
    }
    const double before_root = std::max(from, root * (1 - 1e-12));
    if (depth == 0 || !go_to(method, start, before_root, there_)) return root;
    guards_.look(there_, seen);
    if (!(seen.least > 0)) return root;
    return std::min(root, first_below(method, start, from, at_from, before_root, seen, depth - 1));
  }
  if (depth == 0 || !guards_.may_dip(at_from, at_to, to - from)) return std::numeric_limits<double>::infinity();
  const double middle = 0.5 * (from + to);
  if (!go_to(method, start, middle, there_)) return middle;  // where the flight cannot be followed, it ends
  guards_.look(there_, seen);
  const double first = first_below(method, start, from, at_from, middle, seen, depth - 1);
  return std::isfinite(first) ? first : first_below(method, start, middle, seen, to, at_to, depth - 1);
}

/// From `state` by at most h, to the first impact if there is one.
StepResult EventLocated::fly(Integrator<double>& method, State<double>& state, double h, Flight& flight) {
  start_ = state;
  if (method.has_native_roots()) foresee(state, h);
  one_step_ = resting_.empty();
  StepResult result = one_step_ ? method.step(state, h) : advance(method, state, h);
  if (!result.ok()) {
    state = start_;
    return result;
  }
  flight = {state.t - start_.t, false};
  watch(start_, state);
  if (guards_.empty()) return result;
  searched_ = false;
  // Pairs that come apart at the start are guarded from where they are clear of each other.
  Guards::Look &at_from = looks_[deepest_search + 1], &at_to = looks_[deepest_search + 2];
  double from = 0;
  guards_.look(start_, at_from);
  guards_.look(state, at_to);
  if (at_to.least <= 0 && (guards_.some_leave() || !(at_from.least > 0))) {
    from = flight.length;
    at_from = at_to;
    for (int halvings = 0; halvings < 60 && !(at_from.least > lengths_.met); ++halvings) {
      from *= 0.5;
      if (!go_to(method, start_, from, there_)) break;
      guards_.look(there_, at_from);
    }
    if (!(at_from.least > 0)) {  // they do not come apart at all
      state = start_;
      method.discard_history(state);
      flight = {0, true};
      all_rest_ = true;
      return result;
    }
  }
  const double root = first_below(method, start_, from, at_from, flight.length, at_to, deepest_search);
  if (!std::isfinite(root)) {
    if (searched_) method.discard_history(state);
    return result;
  }
  if (!go_to(method, start_, root, there_)) {
    state = start_;
    return {"the state at an impact could not be reached"};
  }
  state = there_;
  flight = {root, true};
  return result;
}

/// The work of what was held, as far as the flight went; and where the points of transitions have gone with it.
void EventLocated::account_held(const State<double>& end) {
  impulse_bodies(system_, start_.y, bodies_);
  impulse_bodies(system_, end.y, end_);
  const double share = (end.t - start_.t) / whole_;
  for (ImpulseContact& c : resting_) {
    c.impulse *= share;
    book(c, bodies_, end_, losses_);
  }
  for (Transition& t : transitions_) {
    if (t.t == end.t) t.point += line_shift(t.a, t.b, bodies_, end_);
  }
}

StepResult EventLocated::step(Integrator<double>& method, State<double>& state, double h) {
  impacts_.clear();
  transitions_.clear();
  whole_start_ = state;
  const ContactLosses losses_before = losses_;
  const double target = state.t + h;
  // A method that chooses its steps ends its step where it likes, any other where it was told to.
  bool adaptive = false, ended_in_impact = false;
  for (int count = 0;; ++count) {
    if (count > most_impacts) {
      state = whole_start_;
      losses_ = losses_before;
      impacts_.clear();
      transitions_.clear();
      return {"more than " + std::to_string(most_impacts) +
              " impacts in one step; take --impact-timing time_stepping, or a response that answers all points of a "
              "face at once"};
    }
    before_impacts_ = state;
    const ContactLosses losses_before_impacts = losses_;
    const std::size_t impacts_before = impacts_.size();
    const bool met = take_impacts(method, state);
    sinking_ = !met && ended_in_impact;
    double left = target - state.t;
    if (!(left > 0)) break;
    no_bounce_ = false;
    const double longest = method.has_dense_output() ? std::min(left, resting_step) : left;
    const std::size_t transitions_before = transitions_.size();
    const bool held = hold_resting(method, state, longest);
    const bool until_transition = held && whole_ < longest;
    if (held) left = whole_;
    Flight flight;
    const StepResult result = fly(method, state, left, flight);
    if (held) account_held(state);
    held_->release();
    if (!result.ok()) {
      state = whole_start_;
      losses_ = losses_before;
      impacts_.clear();
      transitions_.clear();
      return result;
    }
    if (flight.impact || held) method.discard_history(state);
    if (flight.impact && flight.length == 0 && met) {  // a bounce that the method cannot resolve: none, then
      state = before_impacts_;
      losses_ = losses_before_impacts;
      impacts_.resize(impacts_before);
      method.discard_history(state);
      no_bounce_ = true;
      all_rest_ = false;
    }
    ended_in_impact = flight.impact;
    if (flight.impact) {
      transitions_.resize(transitions_before);  // it did not come so far
      stuck_.clear();
      continue;
    }
    if (until_transition && state.t < target) continue;
    adaptive = state.t < target;
    if (adaptive || flight.length >= left) break;
  }
  if (!adaptive) state.t = target;
  return {};
}

}  // namespace polhode
