// SPDX-License-Identifier: BSD-3-Clause
#include "collision/contact/event_located.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

#include "collision/contact/contact_losses.hpp"

namespace polhode {
namespace {

constexpr double touch_share = 1e-9;       // of the largest body: surfaces so near touch
constexpr double sink_share = 1e-7;        // of the same: a resting pair may sink so far before it is an impact
constexpr double hop_share = 1e-11;        // of the same: a bounce that rises less is not flown
constexpr double quiet = 1e-11;            // m/s, of round-off in a contact that rests
constexpr double resting_step = 1e-3;      // s, at most, through which a method that chooses its steps holds contacts
constexpr int most_impacts = 10000;        // in a step
constexpr int deepest_search = 20;         // halvings of a flight: a dip shorter than 1e-6 of it is not seen

/// As many steps as it takes to go on by h.
StepResult advance(Integrator<double>& method, State<double>& state, double h) {
  const double end = state.t + h;
  StepResult result;
  do {
    result = method.step(state, end - state.t);
  } while (result.ok() && end - state.t > 1e-12 * h);
  if (result.ok()) state.t = end;
  return result;
}

double normal_speed(const std::vector<ImpulseBody>& bodies, const ImpulseContact& c) {
  return (bodies[c.a].velocity_at(c.point) - bodies[c.b].velocity_at(c.point)).dot(c.normal);
}

}  // namespace

EventLocated::EventLocated(System<double>& system, ContactScene& scene, std::unique_ptr<Response> response)
    : system_(system), scene_(scene), response_(std::move(response)) {
  auto held = std::make_unique<HeldImpulses>(system.problem().bodies.size(), scene.all_free());
  held_ = held.get();
  system.add_force(std::move(held));
  double largest = 0;
  for (std::size_t i = 0; i < scene.size(); ++i) largest = std::max(largest, scene.radius(i));
  touch_ = touch_share * largest;
  sink_ = sink_share * largest;
  hop_ = hop_share * largest;
  met_ = 0.1 * hop_;
}

void EventLocated::begin(Integrator<double>& method, const State<double>& state) {
  response_->forget();
  held_->release();
  losses_ = {};
  impacts_.clear();
  bulge_.assign(scene_.size(), 0);
  speed_.assign(scene_.size(), 0);
  rate_ = VectorX<double>::Zero(state.y.size());
  shape_poses(system_, state.y, poses_);
  end_poses_ = poses_;
  scene_.near_pairs(poses_, poses_, bulge_, touch_);
  guards_.clear();
  if (method.has_native_roots()) {
    method.set_events({[this](const State<double>& seen) { return least_guard(seen); }});
  }
}

/// The contact points where surfaces touch, with the speed at which they approach.
std::span<ImpulseContact> EventLocated::touching(const State<double>& state) {
  shape_poses(system_, state.y, poses_);
  guards_.clear();  // they are numbered as the near pairs are
  scene_.near_pairs(poses_, poses_, {}, touch_ + sink_);
  impulse_bodies(system_, state.y, bodies_);
  const std::span<ImpulseContact> all = scene_.contacts(poses_, touch_ + sink_);
  for (ImpulseContact& c : all) c.approach = normal_speed(bodies_, c);
  return all;
}

/// How the velocities change without contact: a short way along the ODE.
void EventLocated::measure_accelerations(const State<double>& state) {
  held_->release();
  system_.rate(state.t, state.y.data(), rate_.data());
  const double fast = rate_.cwiseAbs().maxCoeff();
  const double dt = fast > 0 ? 1e-7 / std::max(1.0, fast) : 1e-7;
  impulse_bodies(system_, state.y + dt * rate_, later_);
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
  return quiet + std::sqrt(2 * hop_ * std::max(-normal_acceleration(c), 0.0));
}

/// Impacts at this instant, all together. True if there was one.
bool EventLocated::take_impacts(Integrator<double>& method, State<double>& state) {
  std::span<ImpulseContact> contacts = touching(state);
  if (contacts.empty()) return false;
  measure_accelerations(state);
  // What still approaches is left to fly; what rests takes its part in an impact.
  const auto apart = [&](const ImpulseContact& c) { return c.depth < -met_ && std::abs(c.approach) > slow(c); };
  contacts = contacts.first(std::size_t(std::remove_if(contacts.begin(), contacts.end(), apart) - contacts.begin()));
  bool any = false;
  rests_from_.assign(contacts.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    ImpulseContact& c = contacts[k];
    const double limit = slow(c), bounce = -c.approach * c.restitution;
    any = any || c.approach < -limit;
    if (bounce <= limit || no_bounce_) {  // its flight would be too low: the series of 2 v eⁿ / a, all at once
      const double pull = -normal_acceleration(c);
      if (bounce > 0 && pull > 0 && c.restitution < 1) rests_from_[k] = state.t + 2 * bounce / pull / (1 - c.restitution);
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
    const double lost = book(c, bodies_, end_, 0, losses_);
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
    if (!all_rest_ && (std::abs(c.approach) > slow(c) || (!rested && c.depth < -hop_))) continue;
    c.restitution = 0;
    c.wanted = 0;
    resting_.push_back(c);
  }
  if (resting_.empty()) return false;
  free_ = state;
  if (!advance(method, free_, h).ok()) return false;
  method.discard_history(state);
  end_ = bodies_;
  impulse_bodies(system_, free_.y, later_);
  for (std::size_t i = 0; i < end_.size(); ++i) {
    end_[i].velocity = later_[i].velocity;
    end_[i].angular_velocity = later_[i].angular_velocity;
  }
  response_->forget();
  response_->resolve(end_, resting_, 0);
  held_->hold(resting_, bodies_, state.t, h);
  whole_ = h;
  all_rest_ = false;
  return true;
}

/// Which pairs may meet on the way, and how fast their distances may change.
void EventLocated::watch(const State<double>& from, const State<double>& to) {
  shape_poses(system_, from.y, poses_);
  shape_poses(system_, to.y, end_poses_);
  impulse_bodies(system_, to.y, end_);
  impulse_bodies(system_, from.y, bodies_);
  const double length = to.t - from.t;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const double turning = std::max(bodies_[i].angular_velocity.norm(), end_[i].angular_velocity.norm()) * scene_.radius(i);
    const double change = (end_[i].velocity - bodies_[i].velocity).norm();
    speed_[i] = 1.1 * (std::max(bodies_[i].velocity.norm(), end_[i].velocity.norm()) + change + turning);
    bulge_[i] = length * (change + turning);
  }
  const std::span<const BodyPair> pairs = scene_.near_pairs(poses_, end_poses_, bulge_, touch_ + sink_);
  guards_.assign(pairs.size(), {});
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Distance d = scene_.distance(k, poses_);
    Guard& g = guards_[k];
    g.speed = speed_[pairs[k].a] + speed_[pairs[k].b];
    const bool held = std::any_of(resting_.begin(), resting_.end(), [&](const ImpulseContact& c) {
      return c.a == pairs[k].a && c.b == pairs[k].b;
    });
    if (held) {
      // As deep as it is, and no deeper: sinking from one bounce to the next would feed them. A body that rolls may sink on.
      g.allowance = std::max(sink_, (sinking_ ? sink_ : 0.01 * hop_) - d.distance);
      g.speed = 0;
      g.leaving = g.allowance > sink_;
    } else if (d.distance <= met_) {
      g.leaving = true;  // it was no impact, so it comes apart
    }
  }
}

double EventLocated::least_guard(const State<double>& state) {
  shape_poses(system_, state.y, end_poses_);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < guards_.size(); ++k) {
    least = std::min(least, scene_.distance(k, end_poses_).distance + guards_[k].allowance);
  }
  return std::isfinite(least) ? least : 1;
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

/// The first instant in (from, to] at which the least guard is not positive; infinity if there is none. It changes no
/// faster than the fastest pair.
double EventLocated::first_below(Integrator<double>& method, const State<double>& start, double from, double value_from,
                                 double to, double value_to, int depth) {
  double fastest = 0;
  for (const Guard& g : guards_) fastest = std::max(fastest, g.speed);
  const auto value = [&](double s) {
    return go_to(method, start, s, there_) ? least_guard(there_) : std::numeric_limits<double>::quiet_NaN();
  };
  if (value_from > 0 && value_to <= 0) {
    double root = to;
    if (value_to < 0) {
      std::uintmax_t rounds = 100;
      const auto bracket = boost::math::tools::toms748_solve(value, from, to, value_from, value_to,
                                                             boost::math::tools::eps_tolerance<double>(52), rounds);
      root = bracket.second;
    }
    if (depth == 0) return root;
    const double before = first_below(method, start, from, value_from, std::max(from, root * (1 - 1e-12)), 0x1p-1000, depth - 1);
    return std::min(root, before);
  }
  if (depth == 0 || value_from + value_to > fastest * (to - from)) return std::numeric_limits<double>::infinity();
  const double middle = 0.5 * (from + to), at_middle = value(middle);
  if (std::isnan(at_middle)) return middle;  // where the flight cannot be followed, it ends
  const double first = first_below(method, start, from, value_from, middle, at_middle, depth - 1);
  return std::isfinite(first) ? first : first_below(method, start, middle, at_middle, to, value_to, depth - 1);
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
  double from = 0, value_from = least_guard(start_);
  const double value_to = least_guard(state);
  const bool leaving = std::any_of(guards_.begin(), guards_.end(), [](const Guard& g) { return g.leaving; });
  if (value_to <= 0 && (leaving || !(value_from > 0))) {
    from = flight.length;
    value_from = value_to;
    for (int halvings = 0; halvings < 60 && !(value_from > met_); ++halvings) {
      from *= 0.5;
      if (!go_to(method, start_, from, there_)) break;
      value_from = least_guard(there_);
    }
    if (!(value_from > 0)) {  // they do not come apart at all
      state = start_;
      method.discard_history(state);
      flight = {0, true};
      all_rest_ = true;
      return result;
    }
  }
  const double root = first_below(method, start_, from, value_from, flight.length, value_to, deepest_search);
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

/// The work of what was held, as far as the flight went.
void EventLocated::account_held(const State<double>& end) {
  impulse_bodies(system_, start_.y, bodies_);
  impulse_bodies(system_, end.y, end_);
  const double share = (end.t - start_.t) / whole_;
  for (ImpulseContact& c : resting_) {
    c.impulse *= share;
    book(c, bodies_, end_, end.t - start_.t, losses_);
  }
}

StepResult EventLocated::step(Integrator<double>& method, State<double>& state, double h) {
  impacts_.clear();
  const State<double> whole_start = state;
  const ContactLosses losses_before = losses_;
  const double target = state.t + h;
  // A method that chooses its steps ends its step where it likes, any other where it was told to.
  bool adaptive = false, ended_in_impact = false;
  State<double> before_impacts;
  for (int count = 0;; ++count) {
    if (count > most_impacts) {
      state = whole_start;
      losses_ = losses_before;
      impacts_.clear();
      return {"more than " + std::to_string(most_impacts) + " impacts in one step; take --impact-timing time_stepping"};
    }
    before_impacts = state;
    const ContactLosses losses_before_impacts = losses_;
    const std::size_t impacts_before = impacts_.size();
    const bool met = take_impacts(method, state);
    sinking_ = !met && ended_in_impact;
    double left = target - state.t;
    if (!(left > 0)) break;
    no_bounce_ = false;
    const bool held = hold_resting(method, state, method.has_dense_output() ? std::min(left, resting_step) : left);
    if (held) left = whole_;
    Flight flight;
    const StepResult result = fly(method, state, left, flight);
    if (held) account_held(state);
    held_->release();
    if (!result.ok()) {
      state = whole_start;
      losses_ = losses_before;
      impacts_.clear();
      return result;
    }
    if (flight.impact || held) method.discard_history(state);
    if (flight.impact && flight.length == 0 && met) {  // a bounce that the method cannot resolve: none, then
      state = before_impacts;
      losses_ = losses_before_impacts;
      impacts_.resize(impacts_before);
      method.discard_history(state);
      no_bounce_ = true;
      all_rest_ = false;
    }
    ended_in_impact = flight.impact;
    if (flight.impact) continue;
    adaptive = state.t < target;
    if (adaptive || flight.length >= left) break;
  }
  if (!adaptive) state.t = target;
  return {};
}

}  // namespace polhode
