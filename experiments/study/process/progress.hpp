// SPDX-License-Identifier: BSD-3-Clause
// Progress of a study: a line that is rewritten in place on a terminal, or separate lines in a log.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace polhode::study::inline process {

/// Prints the progress to standard error. Not thread-safe.
class Progress {
 public:
  /// runs: number of runs to carry out.
  Progress(std::string name, std::size_t runs);
  /// True if report() would print: at most ten times a second on a terminal, at most every ten seconds in a log.
  bool is_due() const;
  /// Prints the number of finished runs, the share of the work that is done (0 to 1) and the time left (s; absent: not
  /// known yet).
  void report(std::size_t runs_done, double share, std::optional<double> seconds_left);
  /// Clears the line, on a terminal.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  std::string name_;
  std::size_t runs_;
  bool terminal_;
  Clock::time_point last_ = Clock::now();
  bool printed_ = false;
};

/// A duration in s as text, rounded up: "8 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

}  // namespace polhode::study::process
