// SPDX-License-Identifier: BSD-3-Clause
#include "collision/contact/sliding_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/contact/contact_kinematics.hpp"
#include "collision/response/contact_frame.hpp"

namespace polhode::inline collision::inline contact {
namespace {

Vector3<double> slip_of(std::span<const ImpulseBody> bodies, const ImpulseContact& c) {
  const Vector3<double> v = relative_velocity(bodies, c);
  return v - v.dot(c.normal) * c.normal;
}

bool same_pair(const ImpulseContact& c, const ImpulseContact& d) { return c.a == d.a && c.b == d.b; }

}  // namespace

void SlidingPairs::find(const ContactHold& hold) {
  slides_.clear();
  for (std::size_t k = 0; k < hold.contacts.size(); ++k) {
    const ImpulseContact& c = hold.contacts[k];
    if (c.friction == 0) continue;  // a frictionless contact never sticks
    if (std::binary_search(stuck_.begin(), stuck_.end(), BodyPair{c.a, c.b})) continue;
    const Vector3<double> slip = slip_of(hold.start, c);
    Slide s{k, slip.norm(), slip.stableNormalized(), 0};
    s.mobility = s.along.dot(mobility_along(hold.start[c.a], hold.start[c.b], c.point, s.along));
    if (!(s.slip > speed_round_off + least_part * s.mobility * c.friction * c.impulse.dot(c.normal))) continue;
    slides_.push_back(s);
  }
}

/// Calls f with the sliding contacts of each pair.
template <class F>
void SlidingPairs::for_each_pair(const ContactHold& hold, const F& f) const {
  const std::span<const Slide> all(slides_);
  for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
    while (last < all.size() && same_pair(hold.contacts[all[first].contact], hold.contacts[all[last].contact])) ++last;
    f(all.subspan(first, last - first));
  }
}

double SlidingPairs::least_slip_at_start(const ContactHold& hold) const {
  double least = std::numeric_limits<double>::infinity();
  for_each_pair(hold, [&](std::span<const Slide> pair) {
    double fastest = 0;
    for (const Slide& s : pair) fastest = std::max(fastest, s.slip);
    least = std::min(least, fastest);
  });
  return least;
}

/// Remaining slip of a pair at the end of the hold, m/s. While some contact point still slides, it is the largest slip
/// in the direction at the start. Otherwise it is negative, by the slip that the unused friction could have stopped.
double SlidingPairs::slip_left(const ContactHold& hold, std::span<const Slide> pair) const {
  double fastest = -std::numeric_limits<double>::infinity(), spare = 0;
  for (const Slide& s : pair) {
    const ImpulseContact& c = hold.contacts[s.contact];
    const Vector3<double> slip = slip_of(hold.end, c);
    if (slip.norm() > least_part * s.slip) fastest = std::max(fastest, slip.dot(s.along));
    spare += s.mobility * (c.friction * c.impulse.dot(c.normal) + c.impulse.dot(s.along));
  }
  return std::isfinite(fastest) ? fastest : -spare;
}

double SlidingPairs::least_slip_left(const ContactHold& hold) const {
  double least = std::numeric_limits<double>::infinity();
  for_each_pair(hold, [&](std::span<const Slide> pair) { least = std::min(least, slip_left(hold, pair)); });
  return least;
}

/// True if a pair that slides at the start has no slip at the end of the hold.
bool SlidingPairs::stops(const ContactHold& hold, std::span<const Slide> pair) const {
  return std::all_of(pair.begin(), pair.end(), [&](const Slide& s) {
    return slip_of(hold.end, hold.contacts[s.contact]).norm() <= speed_round_off + least_part * s.slip;
  });
}

bool SlidingPairs::some_stop(const ContactHold& hold) const {
  bool some = false;
  for_each_pair(hold, [&](std::span<const Slide> pair) { some = some || stops(hold, pair); });
  return some;
}

void SlidingPairs::note_transitions(const ContactHold& hold, double t, std::vector<Transition>& transitions) const {
  for_each_pair(hold, [&](std::span<const Slide> pair) {
    if (!stops(hold, pair)) return;
    const ImpulseContact& c = hold.contacts[pair.front().contact];
    transitions.push_back({t, c.a, c.b, c.point, c.normal});
  });
}

void SlidingPairs::note_stuck(const ContactHold& hold) {
  stuck_.clear();
  for (std::size_t k = 0; k < hold.contacts.size();) {
    const ImpulseContact& first = hold.contacts[k];
    bool sticks = true;
    for (; k < hold.contacts.size() && same_pair(hold.contacts[k], first); ++k) {
      const ImpulseContact& c = hold.contacts[k];
      const double could =
          (hold.start[c.a].inverse_mass + hold.start[c.b].inverse_mass) * c.friction * c.impulse.dot(c.normal);
      sticks = sticks &&
               slip_of(hold.end, c).norm() <= speed_round_off + least_part * (slip_of(hold.start, c).norm() + could);
    }
    if (sticks) stuck_.push_back({first.a, first.b});
  }
}

}  // namespace polhode::collision::contact
