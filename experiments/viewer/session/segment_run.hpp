// SPDX-License-Identifier: BSD-3-Clause
// Run of a segment of a session: a part of the motion in one configuration. Sessions and their reruns both use it, and
// thereby the same loop as every study.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "experiments/study/setup/run_setup.hpp"
#include "experiments/viewer/session/session.hpp"

namespace polhode::viewer::inline session {

class SegmentRun {
 public:
  /// The configuration must be valid: refusal() must return an empty string for it.
  SegmentRun(const study::Scenario& scenario, const Configuration& configuration);

  const System<double>& system() const { return *system_; }

  /// Runs from this state of the system to t_end, or until the observer sets `stop`. The observer receives the initial
  /// state even if its time is t_end. next_step: returns the size of the next step, s, if the drive is the frame clock.
  RunOutcome go(State<double>& state, Observer& observer, const std::atomic<bool>& stop,
                std::function<double()> next_step);

 private:
  Configuration configuration_;
  std::unique_ptr<System<double>> system_;
  std::optional<study::ContactSetup> contact_;
  std::unique_ptr<Integrator<double>> integrator_;
};

/// Hash of the bytes of a state's time and y: 16 hexadecimal digits.
std::string digest(const State<double>& state);
/// Hash of a text: 16 hexadecimal digits.
std::string digest(const std::string& text);

}  // namespace polhode::viewer::session
