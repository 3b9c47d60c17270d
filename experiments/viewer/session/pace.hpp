// SPDX-License-Identifier: BSD-3-Clause
// How much simulated time a session may go on by: wall time times speed adds up, and steps take from it. What a
// simulation that is too slow falls behind by is bounded; beyond that, time is let go, and it is said (Fiedler, Fix
// your timestep!, 2004).
#pragma once

#include <algorithm>

namespace polhode::viewer::inline session {

class Pace {
 public:
  double speed() const { return speed_; }
  void set_speed(double speed) { speed_ = speed; }

  /// Wall time (s) passes while it plays, but for what is held back since another session is slower; `step` (s) is the
  /// least that it must be able to save up for, 0 of a method that chooses its steps.
  void tick(double seconds, double step, double held_back = 0) {
    const double most_behind = std::max(longest_behind * speed_, step);
    let_go_ = let_go_ || owed_ > most_behind || seconds > longest_tick || held_back > 0;
    owed_ = std::min(owed_, most_behind);
    owed_ += std::clamp(seconds - held_back, 0.0, longest_tick) * speed_;
    wall_ += seconds;
    if (wall_ < measured_over) return;
    pace_ = went_ / wall_;
    slower_ = let_go_;
    wall_ = went_ = 0;
    let_go_ = false;
  }

  /// Takes a step of that size, if there is time for it.
  bool take(double step) {
    if (owed_ < step * (1 - rounding)) return false;
    owed_ -= step;
    return true;
  }
  bool owes() const { return owed_ > 0; }
  /// All that is owed, in one step.
  double take_all() {
    const double all = owed_;
    owed_ = 0;
    return all;
  }
  /// A step whose size nobody knew before.
  void took(double step) { owed_ -= step; }
  /// Simulated time (s) has passed.
  void went(double step) { went_ += step; }

  /// Nothing is owed any more.
  void forget() { owed_ = wall_ = went_ = 0; }

  /// s of the wall, that it would take to catch up.
  double behind() const { return std::max(owed_, 0.0) / speed_; }

  static constexpr double longest_behind = 0.25;  ///< s of the wall

  double pace() const { return pace_; }  ///< simulated seconds for one of the wall, over the last second
  bool slower() const { return slower_; }

 private:
  static constexpr double longest_tick = 1, measured_over = 1;  // s of the wall
  static constexpr double rounding = 1e-9;

  double speed_ = 1, owed_ = 0;
  double wall_ = 0, went_ = 0, pace_ = 0;
  bool let_go_ = false, slower_ = false;
};

}  // namespace polhode::viewer
