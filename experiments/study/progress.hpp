// SPDX-License-Identifier: BSD-3-Clause
// Progress of a study: a line that is rewritten in place on a terminal, or separate lines in a log.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace polhode::study {

/// Prints the progress to standard error. Not thread-safe.
class Progress {
 public:
  /// runs: number of runs to carry out; cost: their total work, in any unit.
  Progress(std::string name, std::size_t runs, double cost);
  /// Reports the number and the cost of finished runs. Prints at most ten times a second on a terminal, at most every
  /// ten seconds in a log.
  void report(std::size_t runs_done, double cost_done);
  /// Clears the line, on a terminal.
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

/// A duration in s as text, rounded up: "8 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

}  // namespace polhode::study
