// SPDX-License-Identifier: BSD-3-Clause
// Observer of the segments of a session. It keeps the present state, its energy ledger summed over all segments, and
// the state before the last step.
#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/run/simulate.hpp"
#include "experiments/viewer/session/session_memory.hpp"

namespace polhode::viewer::inline session {

class SegmentObserver final : public Observer {
 public:
  /// `after_step` is called after the start of a segment (`first`) and after each of its steps.
  SegmentObserver(SessionMemory& memory, std::function<void(bool first)> after_step)
      : memory_(memory), after_step_(std::move(after_step)) {}

  const Kept& present() const { return present_; }
  /// The state before the last step.
  const State<double>& before() const { return before_; }
  /// Impacts of the last step.
  std::span<const Impact> impacts() const { return impacts_; }

  /// Sets the start of the next segment. fresh: the session starts anew.
  void place(Kept start, bool fresh);
  void begin_segment();

  void on_start(const State<double>& state, const Sample& sample) override;
  std::size_t on_samples(std::span<const Sample> samples) override;
  void on_state(const State<double>& state, const Sample& sample) override;
  void on_multipliers(std::span<const double> multipliers) override {
    multipliers_ = Eigen::Map<const VectorX<double>>(multipliers.data(), Eigen::Index(multipliers.size()));
  }
  void on_impacts(std::span<const Impact> impacts) override {
    impacts_.insert(impacts_.end(), impacts.begin(), impacts.end());
  }
  void on_contact_energy(const ContactLosses& losses) override { losses_ = losses; }
  double next_state() const override { return 0; }

 private:
  void keep(const State<double>& state, const Sample& sample);

  SessionMemory& memory_;
  std::function<void(bool)> after_step_;
  Kept present_;
  State<double> before_;
  std::vector<Impact> impacts_;
  VectorX<double> multipliers_;           ///< multipliers of the method at the state that is due
  double projection_before_ = 0;          ///< energy injected by projection in earlier segments, J
  ContactLosses losses_before_, losses_;  ///< losses in earlier segments, and in the present one
  bool fresh_ = true;                     ///< the segment is the start of the session
};

}  // namespace polhode::viewer::session
