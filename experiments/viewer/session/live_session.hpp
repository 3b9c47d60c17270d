// SPDX-License-Identifier: BSD-3-Clause
// A session that simulates. Its thread goes through core/simulate, segment by segment, and is the observer there: after
// each step it keeps the state, lets the window see it, applies what commands have come, and waits for the next step's
// turn.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "experiments/viewer/session/contact_lookout.hpp"
#include "experiments/viewer/session/pace.hpp"
#include "experiments/viewer/session/segment_run.hpp"
#include "experiments/viewer/session/session_memory.hpp"

namespace polhode::viewer {

class LiveSession final : public Session, private Observer {
 public:
  explicit LiveSession(const SessionSetup& setup);
  ~LiveSession() override;

  const study::Scenario& scenario() const override { return scenario_; }
  std::shared_ptr<const View> view() override;
  void tick(double seconds, double held_back) override;
  double behind() const override;
  void play() override;
  void pause() override;
  void step(std::int64_t count) override;
  void reset() override;
  void set_speed(double speed) override;
  void scrub(double t) override;
  void pause_on_collision(bool on) override;
  void want(const Wanted& wanted) override;
  std::string change(const Configuration& configuration) override;
  void settle() override;
  std::string finish() override;

 private:
  // The window's side

  void send(std::function<void()> command);

  // The thread of the simulation, which alone touches what stands below "its own"

  void work();
  void go_through_segment();
  void finish_segment(const RunOutcome& outcome);
  std::size_t observe(std::span<const Sample> samples) override;
  void look(const State<double>& state, const Sample& sample) override;
  void meet(std::span<const Impact> impacts) override {
    impacts_.insert(impacts_.end(), impacts.begin(), impacts.end());
  }
  void account(const ContactLosses& losses) override;
  double next_look() const override { return 0; }

  void wait();
  void apply_news();
  void pass_time(double seconds, double held_back);
  bool may_step();
  template <class F>
  void or_say(const F& act);
  void halt();
  void watch_collisions();
  std::optional<Kept> at_impact(std::span<const BodyPair> met);
  void fork_from(Kept origin, const Configuration& configuration);
  void begin_again();
  void leave_for_new();
  void renew_lookout();
  void leave_the_past();
  void publish();

  void record_segment(SegmentStart from);
  void record_steps();
  template <class F>
  void record(const F& write);

  const study::Scenario scenario_;
  const std::vector<study::Override> overrides_;
  const std::filesystem::path trajectory_;

  // Shared

  mutable std::mutex mutex_;
  std::condition_variable news_came_, became_idle_;
  std::vector<std::function<void()>> commands_;
  double ticked_ = 0, held_back_ = 0;  ///< s, not yet taken
  double behind_ = 0;                  ///< s, of what was taken
  bool idle_ = false;
  std::shared_ptr<const View> view_;
  std::atomic<bool> view_wanted_{false}, news_{false}, quit_{false};

  // Its own

  SessionMemory memory_;
  Configuration configuration_;
  Pace pace_;
  std::optional<ContactLookout> lookout_;  ///< where the scenario has contact
  std::unique_ptr<SessionWriter> writer_;
  Kept present_;
  State<double> before_;        ///< a step earlier
  std::optional<Kept> past_;    ///< scrubbed back to
  std::optional<Kept> impact_;  ///< within the last step, where it paused
  std::vector<FrameContact> impact_contacts_;
  std::vector<Impact> impacts_;   ///< of the last step
  double projection_before_ = 0;  ///< J, in the segments before this one
  ContactLosses losses_before_, losses_;
  std::int64_t segment_ = 0;
  Wanted wanted_;
  std::atomic<bool> stop_{false};  ///< ends the run of a segment
  bool first_look_ = true;         ///< of a segment
  bool fresh_ = true;              ///< the segment is the start of all
  bool leaving_ = false;           ///< for another segment
  bool playing_ = false, at_end_ = false, failed_ = false, paused_at_collision_ = false, pause_on_collision_ = false;
  std::int64_t steps_wanted_ = 0;
  double next_size_ = 0;             ///< s, where the frame clock drives
  std::string message_, trouble_;    ///< why it stopped; what else went wrong
  std::string unwritten_;            ///< the first file that could not be written, and why
  bool changed_ = true;              ///< since the view was made
  std::int64_t recorded_steps_ = 0;  ///< of this segment
  std::vector<double> unrecorded_sizes_;
  double since_record_ = 0;  ///< s of the wall

  std::thread thread_;  ///< last: it starts when all else is there
};

}  // namespace polhode::viewer
