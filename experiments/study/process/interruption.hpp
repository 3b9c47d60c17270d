// SPDX-License-Identifier: BSD-3-Clause
// Signals that end a study early: Ctrl-C (SIGINT), and the warnings that a batch system sends before it kills a job
// (SIGTERM, SIGUSR1, SIGXCPU). All of them mean the same.
#pragma once

#include <atomic>

namespace polhode::study::inline process {

/// Exit status of an interrupted study: EX_TEMPFAIL of sysexits.h. The same command continues the study.
inline constexpr int interrupted = 75;

/// Time that runs under way have to finish after the first signal, s.
inline constexpr unsigned grace = 5;

/// Handles the signals while it lives; restores their former actions at the end. At most one object at a time.
///   first signal:  no further run begins; runs under way have `grace` seconds to finish
///   second signal: runs under way are stopped at once; finished runs are kept
/// Where no run is under way, ends_at_once() makes a signal end the process at once.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// True: no further run may begin.
  std::atomic<bool>& no_more();
  /// True: runs under way must end.
  std::atomic<bool>& stop();

  /// From now on a signal prints the message, which ends with a newline, and ends the process with the exit status
  /// `interrupted`: nothing is under way that could be lost. `message` must outlive the object.
  void ends_at_once(const char* message);
  /// From now on signals are handled as above.
  void runs_begin();
};

}  // namespace polhode::study::process
