// SPDX-License-Identifier: BSD-3-Clause
// Scheduling of the steps of a session: while it plays, steps are due by its pace; while it is paused, only requested
// single steps are taken.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "experiments/viewer/session/pace.hpp"
#include "experiments/viewer/session/session.hpp"

namespace polhode::viewer::inline session {

class Playback {
 public:
  Pace& pace() { return pace_; }
  const Pace& pace() const { return pace_; }
  bool playing() const { return playing_; }
  bool at_end() const { return at_end_; }
  bool failed() const { return failed_; }
  /// Reason for which the motion ended; empty if it has not ended.
  const std::string& message() const { return message_; }

  void play() {
    playing_ = !at_end_;
    pace_.forget();
  }
  /// Pauses, and requests `count` more steps.
  void step(std::int64_t count) {
    playing_ = false;
    if (!at_end_) steps_wanted_ += std::max<std::int64_t>(count, 0);
  }
  void halt() {
    playing_ = false;
    steps_wanted_ = 0;
    pace_.forget();
  }
  /// Ends the motion: no step is taken until begin_motion().
  void end(bool failed, const std::string& message) {
    at_end_ = true;
    failed_ = failed;
    message_ = message;
    halt();
  }
  /// Begins another motion, which has not ended.
  void begin_motion() {
    at_end_ = failed_ = false;
    message_.clear();
  }
  void begin_segment() { next_size_ = 0; }

  /// Adds elapsed wall time, s. Returns false if it does not count, because the session is paused or at its end.
  bool pass_time(double seconds, double held_back, const Configuration& configuration) {
    if (!playing_ || at_end_) return false;
    pace_.tick(seconds, configuration.run.dt.value_or(0), held_back);
    return true;
  }

  /// Returns true if a step is due, and sets its size unless the method is adaptive.
  bool may_step(const Configuration& configuration) {
    if (at_end_) return false;
    next_size_ = configuration.run.dt.value_or(0);
    if (steps_wanted_ > 0) {
      --steps_wanted_;
      return true;
    }
    if (!playing_) return false;
    if (!configuration.run.dt) return pace_.owes();
    if (configuration.drive == Drive::accumulator) return pace_.take(next_size_);
    next_size_ = pace_.take_all();
    return next_size_ > 0;
  }
  /// Size of the next step if the drive is the frame clock, s.
  double next_size() const { return next_size_; }

  /// Reports a step that was taken; length: its simulated time, s.
  void stepped(double length, const Configuration& configuration) {
    pace_.went(length);
    if (playing_ && !configuration.run.dt) pace_.took(length);
  }

 private:
  Pace pace_;
  bool playing_ = false, at_end_ = false, failed_ = false;
  std::int64_t steps_wanted_ = 0;
  double next_size_ = 0;  ///< size of the next step, s
  std::string message_;
};

}  // namespace polhode::viewer::session
