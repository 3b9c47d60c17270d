// SPDX-License-Identifier: BSD-3-Clause
// Pause at a collision: a session pauses when two bodies begin to touch. It shows the state at their first impact and
// the contact points, while the run itself is at the end of the step.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "experiments/viewer/session/contact_lookout.hpp"
#include "experiments/viewer/session/segment_observer.hpp"

namespace polhode::viewer::inline session {

class CollisionPause {
 public:
  /// Sets the contact detection of this run; without effect if the run has no contact.
  void configure(const study::Scenario& scenario, const study::RunConfig& run);

  /// Turns the pause at collisions on or off.
  void set(bool on) { on_ = on; }
  bool on() const { return on_ && lookout_; }

  // The following functions require that the pause is on.

  /// Pairs that touch in the state y do not count as colliding later.
  void begin(const System<double>& system, const VectorX<double>& y) { lookout_->begin(system, y); }
  /// The pairs that began to touch in the last step.
  std::vector<BodyPair> newly_met(const System<double>& system, const SegmentObserver& segment);
  /// Pauses at the first impact of these pairs within the last step.
  void pause(const System<double>& system, const study::RunConfig& run, const SegmentObserver& segment,
             std::span<const BodyPair> met);

  void leave() {
    paused_ = false;
    impact_.reset();
  }
  bool paused() const { return paused_; }
  /// The state shown during the pause; absent: the state at the end of the step.
  const std::optional<Kept>& state() const { return impact_; }

  /// Sets the contacts and cells of a frame that shows the state y. at_pause: y is the state of the pause.
  void show(const Wanted& wanted, bool at_pause, const System<double>& system, const VectorX<double>& y, Frame& frame);

 private:
  std::optional<ContactLookout> lookout_;  ///< search for new contacts; absent if the scenario has no contact
  bool on_ = false, paused_ = false;
  std::optional<Kept> impact_;
  std::vector<FrameContact> contacts_;
};

}  // namespace polhode::viewer::session
