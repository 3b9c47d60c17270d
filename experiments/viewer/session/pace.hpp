// SPDX-License-Identifier: BSD-3-Clause
// Accumulator of simulated time that a session is due to advance by: wall time times speed is added, and the sizes of
// steps are subtracted. Its value is bounded for a simulation that is too slow: time beyond the bound is dropped, which
// is reported (Fiedler, Fix your timestep!, 2004).
#pragma once

#include <algorithm>

namespace polhode::viewer::inline session {

class Pace {
 public:
  double speed() const { return speed_; }
  void set_speed(double speed) { speed_ = speed; }

  /// Adds elapsed wall time, s, while the session plays. step: size of the next step, s, which the bound must allow; 0
  /// for an adaptive method. held_back: part of the wall time, s, that is dropped because another session is slower.
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

  /// Subtracts a step (s) if it is due; returns false otherwise.
  bool take(double step) {
    if (owed_ < step * (1 - rounding)) return false;
    owed_ -= step;
    return true;
  }
  bool owes() const { return owed_ > 0; }
  /// Subtracts and returns all time that is due, s.
  double take_all() {
    const double all = owed_;
    owed_ = 0;
    return all;
  }
  /// Subtracts a step (s) of an adaptive method after it was taken.
  void took(double step) { owed_ -= step; }
  /// Adds simulated time (s) to the measurement of the pace.
  void went(double step) { went_ += step; }

  /// Discards all time that is due, and the measurement of the pace.
  void forget() { owed_ = wall_ = went_ = 0; }

  /// Wall time that is still to be simulated, s.
  double behind() const { return std::max(owed_, 0.0) / speed_; }

  static constexpr double longest_behind = 0.25;  ///< largest value of behind(), s of wall time

  double pace() const { return pace_; }  ///< simulated time over wall time, measured over the last second
  bool slower() const { return slower_; }

 private:
  static constexpr double longest_tick = 1, measured_over = 1;  // s of wall time
  static constexpr double rounding = 1e-9;

  double speed_ = 1, owed_ = 0;
  double wall_ = 0, went_ = 0, pace_ = 0;
  bool let_go_ = false, slower_ = false;
};

}  // namespace polhode::viewer::session
