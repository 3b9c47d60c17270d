// SPDX-License-Identifier: BSD-3-Clause
// How far a study is: a line that rewrites itself on a terminal, plain lines now and then in a log.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace polhode::study {

/// Not thread-safe: one thread reports.
class Progress {
 public:
  /// `cost` in any unit, of all runs; `runs` counts those to be carried out now.
  Progress(std::string name, std::size_t runs, double cost);
  /// Call as often as you like; prints at most ten times a second on a terminal, every ten seconds in a log.
  void report(std::size_t runs_done, double cost_done);
  /// Clears the line on a terminal.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  std::string name_;
  std::size_t runs_;
  double cost_;
  bool terminal_;
  Clock::time_point started_ = Clock::now(), last_ = started_;
  bool printed_ = false;
};

/// "8 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

}  // namespace polhode::study
