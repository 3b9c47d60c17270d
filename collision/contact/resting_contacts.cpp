// SPDX-License-Identifier: BSD-3-Clause
#include "collision/contact/resting_contacts.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

#include "collision/contact/contact_losses.hpp"
#include "collision/contact/flight_path.hpp"

namespace polhode::inline collision::inline contact {

bool RestingContacts::hold(Integrator<double>& method, const State<double>& state, double h,
                           std::span<ImpulseContact> touching, ContactKinematics& kinematics, bool all) {
  std::swap(hold_.contacts, rested_);
  hold_.contacts.clear();
  if (touching.empty()) return false;
  kinematics.measure_accelerations(state);
  for (ImpulseContact& c : touching) {
    // A low bounce is slow at its apex and must not count as rest. Only a pair that rested before may have a gap above
    // the minimum bounce height.
    const auto same_pair = [&](const ImpulseContact& r) { return r.a == c.a && r.b == c.b; };
    const bool rested = std::any_of(rested_.begin(), rested_.end(), same_pair);
    if (!all &&
        (std::abs(c.approach) > kinematics.resting_speed(c) || (!rested && c.depth < -lengths_.minimum_bounce_height)))
      continue;
    c.restitution = 0;
    c.wanted = 0;
    hold_.contacts.push_back(c);
  }
  if (hold_.contacts.empty()) return false;
  hold_.start = kinematics.bodies();
  if (!resolve(method, state, h)) return false;
  hold_.length = first_slide_end(method, state, h);
  if (!(hold_.length > 0)) return false;
  slides_.note_stuck(hold_);
  contact_forces_.hold(hold_.contacts, hold_.start, hold_.length);
  return true;
}

/// Computes the impulses that hold the contacts for h (s). False if the method fails.
bool RestingContacts::resolve(Integrator<double>& method, const State<double>& state, double h) {
  free_ = state;
  const bool done = advance(method, free_, h).ok();
  method.discard_history(state);
  if (!done) return false;
  hold_.end.assign(hold_.start.begin(), hold_.start.end());
  impulse_bodies(system_, free_.y, later_);
  for (std::size_t i = 0; i < hold_.end.size(); ++i) {
    hold_.end[i].velocity = later_[i].velocity;
    hold_.end[i].angular_velocity = later_[i].angular_velocity;
  }
  response_.forget();
  response_.resolve(hold_.end, hold_.contacts, 0);
  return true;
}

/// Time (s) from the start of a resolved hold of h (s) until the first pair stops sliding; h if none does; 0 if the
/// method fails. Resolves the hold again for this duration.
double RestingContacts::first_slide_end(Integrator<double>& method, const State<double>& state, double h) {
  slides_.find(hold_);
  if (slides_.empty()) return h;
  const double slip_at_start = slides_.least_slip_at_start(hold_);
  const double left = slides_.least_slip_left(hold_);
  if (!(left < 0)) return h;
  const auto value = [&](double s) {
    return resolve(method, state, s) ? slides_.least_slip_left(hold_) : std::numeric_limits<double>::quiet_NaN();
  };
  constexpr double brief = SlidingPairs::least_part;
  const auto close = [&](double low, double high) { return high - low <= 0.1 * brief * h; };
  std::uintmax_t rounds = 40;
  const double end = boost::math::tools::toms748_solve(value, 0.0, h, slip_at_start, left, close, rounds).second;
  if (end > brief * h && end < h && resolve(method, state, end) && slides_.some_stop(hold_)) return end;
  return resolve(method, state, h) ? h : 0;  // the slip changed its direction without a stop
}

void RestingContacts::account(const State<double>& start, const State<double>& end, ContactLosses& losses,
                              std::span<Transition> transitions) {
  impulse_bodies(system_, start.y, bodies_);
  impulse_bodies(system_, end.y, later_);
  const double share = (end.t - start.t) / hold_.length;
  for (ImpulseContact& c : hold_.contacts) {
    c.impulse *= share;
    book(c, bodies_, later_, losses);
  }
  for (Transition& t : transitions) {
    if (t.t == end.t) t.point += line_shift(t.a, t.b, bodies_, later_);
  }
}

}  // namespace polhode::collision::contact
