// SPDX-License-Identifier: BSD-3-Clause
// A session that simulates. Its thread runs simulate(), segment by segment. After each step it publishes a view if the
// window requested one, applies received commands, and waits until the next step is due. Its parts:
//   CommandQueue     commands and wall time from the window's thread
//   Playback         time of the next step
//   SegmentObserver  present state
//   CollisionPause   pause at collisions
//   SessionRecorder  output files
//   ViewPublisher    contents of the window
#pragma once

#include <atomic>
#include <optional>
#include <thread>

#include "experiments/viewer/session/collision_pause.hpp"
#include "experiments/viewer/session/command_queue.hpp"
#include "experiments/viewer/session/playback.hpp"
#include "experiments/viewer/session/segment_observer.hpp"
#include "experiments/viewer/session/session_memory.hpp"
#include "experiments/viewer/session/session_recorder.hpp"
#include "experiments/viewer/session/view_publisher.hpp"

namespace polhode::viewer::inline session {

class LiveSession final : public Session {
 public:
  explicit LiveSession(const SessionSetup& setup);
  ~LiveSession() override;

  const study::Scenario& scenario() const override { return scenario_; }
  std::shared_ptr<const View> view() override { return publisher_.latest(); }
  void tick(double seconds, double held_back) override;
  double behind() const override { return queue_.behind(); }
  void play() override;
  void pause() override;
  void step(std::int64_t count) override;
  void reset() override;
  void set_speed(double speed) override;
  void scrub(double t) override;
  void pause_on_collision(bool on) override;
  void want(const Wanted& wanted) override;
  std::string change(const Configuration& configuration) override;
  void settle() override { queue_.settle(); }
  std::string finish() override;

 private:
  // The following functions are called by the simulation's thread only.

  void work();
  void go_through_segment();
  void finish_segment(const RunOutcome& outcome);
  void after_step(bool first);
  void stop_at_collision();

  void wait();
  void apply_news();
  template <class F>
  void or_say(const F& act);
  void write_steps();

  void leave_the_past();
  void fork_from(Kept origin, const Configuration& configuration);
  void begin_again();
  void begin_segment(Kept start, bool fresh, SegmentStart from);
  void publish();

  const System<double>& present_system() { return memory_.system(segment_.present().formulation); }

  const study::Scenario scenario_;
  const std::vector<study::Override> overrides_;

  CommandQueue queue_;
  ViewPublisher publisher_;

  // The following members are used by the simulation's thread only.

  SessionMemory memory_;
  Configuration configuration_;
  Playback playback_;
  SegmentObserver segment_;
  CollisionPause collision_;
  SessionRecorder recorder_;
  std::optional<Kept> past_;  ///< earlier state selected by scrub()
  Wanted wanted_;
  std::int64_t segment_number_ = 0;
  std::atomic<bool> stop_{false};  ///< ends the run of a segment
  bool leaving_ = false;           ///< the present segment is to be replaced by another one
  std::string trouble_;            ///< message of an error other than one of the motion

  std::thread thread_;  ///< must be the last member: the thread uses all others
};

}  // namespace polhode::viewer::session
