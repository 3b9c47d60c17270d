// SPDX-License-Identifier: BSD-3-Clause
// The pairs that slide while their contacts are held, and the end of the sliding phase. It is the root of the remaining
// slip as a function of the duration of the hold.
#pragma once

#include <span>
#include <vector>

#include "collision/broad_phase.hpp"
#include "collision/response.hpp"
#include "core/run/contact_model.hpp"

namespace polhode::inline collision::inline contact {

/// Contacts that are held for some time, with the impulses over that time.
struct ContactHold {
  std::vector<ImpulseContact> contacts;  ///< sorted by pairs
  std::span<const ImpulseBody> start;    ///< bodies at the start of the hold
  std::vector<ImpulseBody> end;          ///< bodies with the velocities at the end and the positions at the start
  double length = 0;                     ///< duration, s
};

/// The sliding pairs of a hold, and the pairs that stick at its end.
class SlidingPairs {
 public:
  /// Threshold as a fraction. A sliding phase shorter than this fraction of a hold is ignored. A remaining slip below
  /// this fraction of the initial slip counts as zero.
  static constexpr double least_part = 1e-6;

  /// Clears the list of sticking pairs.
  void clear() { stuck_.clear(); }

  /// Finds the contacts that slide at the start of a hold. A pair that stuck at the end of the last hold does not
  /// slide; its slip is an error of the method.
  void find(const ContactHold& hold);
  bool empty() const { return slides_.empty(); }

  /// Slip of the slowest pair at the start of the hold, m/s.
  double least_slip_at_start(const ContactHold& hold) const;
  /// Slip of the slowest pair at the end of the hold, m/s. It is negative if friction stopped the pair before the end.
  double least_slip_left(const ContactHold& hold) const;
  /// True if some pair has no slip at the end of the hold.
  bool some_stop(const ContactHold& hold) const;

  /// Appends the pairs that stop sliding at the end of the hold, time t (s).
  void note_transitions(const ContactHold& hold, double t, std::vector<Transition>& transitions) const;
  /// Stores the pairs that stick or roll at the end of the hold.
  void note_stuck(const ContactHold& hold);

 private:
  /// A contact that slides at the start of a hold.
  struct Slide {
    std::size_t contact;    ///< index of the contact in the hold
    double slip;            ///< slip speed at the start, m/s
    Vector3<double> along;  ///< unit vector of the slip, world axes
    double mobility;        ///< change of the slip in that direction per unit impulse, 1/kg
  };

  template <class F>
  void for_each_pair(const ContactHold& hold, const F& f) const;
  double slip_left(const ContactHold& hold, std::span<const Slide> pair) const;
  bool stops(const ContactHold& hold, std::span<const Slide> pair) const;

  std::vector<Slide> slides_;
  std::vector<BodyPair> stuck_;  ///< pairs that stuck at the end of the last hold, sorted
};

}  // namespace polhode::collision::contact
