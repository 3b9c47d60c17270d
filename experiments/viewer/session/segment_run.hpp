// SPDX-License-Identifier: BSD-3-Clause
// A segment of a session: a stretch of the motion in one configuration, from a state to where it is left. A session and
// its rerun both go through it here, and so through the same loop as every study.
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
  /// The configuration must be one that refusal() accepts.
  SegmentRun(const study::Scenario& scenario, const Configuration& configuration);

  const System<double>& system() const { return *system_; }

  /// From this state, of the system, to t_end or until `stop` is set in a look of the observer, who sees the start even
  /// where that is t_end. `next_step` is asked where the frame clock drives.
  RunOutcome go(State<double>& state, Observer& observer, const std::atomic<bool>& stop,
                std::function<double()> next_step);

 private:
  Configuration configuration_;
  std::unique_ptr<System<double>> system_;
  std::optional<study::ContactSetup> contact_;
  std::unique_ptr<Integrator<double>> integrator_;
};

/// 16 hexadecimal digits that tell states apart: of the bytes of time and y.
std::string digest(const State<double>& state);
/// The same of a text.
std::string digest(const std::string& text);

}  // namespace polhode::viewer
