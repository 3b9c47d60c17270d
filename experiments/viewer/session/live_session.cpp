// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/session/live_session.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "experiments/study/setup/run_setup.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/viewer/session/segment_run.hpp"
#include "experiments/viewer/session/state_conversion.hpp"

namespace polhode::viewer::inline session {
namespace {

Configuration configuration_of(const SessionSetup& setup, const study::Scenario& scenario) {
  Configuration c = setup.configuration.value_or(usual_configuration(scenario));
  c.run.scenario = scenario.name;
  c.run.varied = setup.overrides;
  if (std::string reason = refusal(c, scenario); !reason.empty())
    throw study::InputError(scenario.name + ": " + reason);
  return c;
}

}  // namespace

LiveSession::LiveSession(const SessionSetup& setup)
    : scenario_(study::ScenarioSource::open(setup.scenario).resolve(setup.overrides)),
      overrides_(setup.overrides),
      memory_(scenario_, setup.history_bytes),
      configuration_(configuration_of(setup, scenario_)),
      segment_(memory_, [this](bool first) { after_step(first); }),
      recorder_(setup, scenario_) {
  begin_again();
  collision_.configure(scenario_, configuration_.run);
  publish();
  thread_ = std::thread([this] { work(); });
}

LiveSession::~LiveSession() { finish(); }

std::string LiveSession::finish() {
  queue_.quit();
  if (thread_.joinable()) thread_.join();
  return recorder_.unwritten();
}

// Commands of the window's thread.

void LiveSession::tick(double seconds, double held_back) {
  if (seconds > 0) queue_.tick(seconds, held_back);
}

void LiveSession::play() {
  queue_.send([this] {
    leave_the_past();
    playback_.play();
    collision_.leave();
  });
}

void LiveSession::pause() {
  queue_.send([this] { playback_.halt(); });
}

void LiveSession::step(std::int64_t count) {
  queue_.send([this, count] {
    leave_the_past();
    collision_.leave();
    playback_.step(count);
  });
}

void LiveSession::reset() {
  queue_.send([this] {
    playback_.halt();
    begin_again();
  });
}

void LiveSession::set_speed(double speed) {
  if (!(speed > 0) || !std::isfinite(speed)) throw std::invalid_argument("a speed must be a positive number");
  queue_.send([this, speed] { playback_.pace().set_speed(speed); });
}

void LiveSession::scrub(double t) {
  if (std::isnan(t)) return;
  queue_.send([this, t] {
    playback_.halt();
    collision_.leave();
    const Kept& present = segment_.present();
    const Kept& nearest = memory_.nearest(t, present);
    if (nearest.step == present.step) past_.reset();
    else past_ = nearest;
  });
}

void LiveSession::pause_on_collision(bool on) {
  queue_.send([this, on] {
    collision_.set(on);
    if (collision_.on()) collision_.begin(present_system(), segment_.present().state.y);
  });
}

void LiveSession::want(const Wanted& wanted) {
  queue_.send([this, wanted] {
    wanted_ = wanted;
    memory_.trace(wanted.traced);
  });
}

std::string LiveSession::change(const Configuration& configuration) {
  Configuration c = configuration;
  c.run.scenario = scenario_.name;
  c.run.varied = overrides_;
  if (std::string reason = refusal(c, scenario_); !reason.empty()) return reason;
  queue_.send([this, c] {
    fork_from(past_ ? *past_ : segment_.present(), c);
    collision_.configure(scenario_, configuration_.run);
  });
  return {};
}

// Loop of the simulation's thread.

void LiveSession::work() {
  while (!queue_.has_quit()) {
    leaving_ = false;
    go_through_segment();
    publisher_.outdate();
    if (!leaving_ && !queue_.has_quit()) wait();
  }
  write_steps();
}

void LiveSession::go_through_segment() {
  stop_ = false;
  playback_.begin_segment();
  segment_.begin_segment();
  try {
    SegmentRun run(scenario_, configuration_);
    State<double> state = segment_.present().state;
    const auto rows = recorder_.trajectory(segment_number_, run.system());
    Observers observers;
    if (rows) observers.add(*rows);
    observers.add(segment_);
    finish_segment(run.go(state, observers, stop_, [this] { return playback_.next_size(); }));
    if (rows) {
      rows->close();
      recorder_.finish_trajectory(segment_number_);
    }
  } catch (const std::exception& error) {
    recorder_.trajectory_broke_off(error.what());  // in any case the trajectory is incomplete
    finish_segment({.status = RunStatus::failed, .message = error.what()});
  }
}

void LiveSession::finish_segment(const RunOutcome& outcome) {
  if (outcome.status == RunStatus::interrupted) return;
  const bool failed = outcome.status != RunStatus::ok;
  const bool early = !failed && segment_.present().state.t < configuration_.run.t_end;
  playback_.end(failed, early ? "the run ends at its first impact" : outcome.message);
}

/// Called after the start of a segment and after each of its steps; returns when the next step is due.
void LiveSession::after_step(bool first) {
  const State<double>& state = segment_.present().state;
  if (first) {
    if (collision_.on()) collision_.begin(present_system(), state.y);
  } else {
    if (configuration_.drive == Drive::frame_clock) recorder_.add_size(playback_.next_size());
    playback_.stepped(state.t - segment_.before().t, configuration_);
    if (collision_.on()) or_say([this] { stop_at_collision(); });
  }
  publisher_.outdate();
  if (publisher_.take_wanted()) publish();
  wait();
}

void LiveSession::stop_at_collision() {
  const System<double>& system = present_system();
  const std::vector<BodyPair> met = collision_.newly_met(system, segment_);
  if (met.empty()) return;
  playback_.halt();
  collision_.pause(system, configuration_.run, segment_, met);
}

/// Waits until the next step is due or the segment ends.
void LiveSession::wait() {
  for (;;) {
    apply_news();
    if (queue_.has_quit() || leaving_) {
      stop_ = true;
      return;
    }
    if (playback_.may_step(configuration_)) return;
    if (!playback_.playing()) write_steps();
    if (publisher_.outdated()) publish();
    queue_.wait();
  }
}

void LiveSession::apply_news() {
  if (!queue_.has_news()) return;
  const CommandQueue::News news = queue_.take(playback_.playing(), playback_.pace().behind());
  for (const CommandQueue::Command& command : news.commands) or_say(command);
  if (news.seconds > 0 && playback_.pass_time(news.seconds, news.held_back, configuration_) &&
      recorder_.pass_time(news.seconds))
    write_steps();
  if (news.commands.empty()) return;
  write_steps();
  publisher_.outdate();
}

/// Calls act() and turns an exception into a message, so that errors outside the motion end neither it nor the thread.
template <class F>
void LiveSession::or_say(const F& act) {
  try {
    act();
  } catch (const std::exception& error) {
    trouble_ = error.what();
  }
}

void LiveSession::write_steps() {
  or_say([this] { recorder_.write_steps(segment_.present()); });
}

// Start of segments.

void LiveSession::leave_the_past() {
  if (past_) fork_from(*past_, configuration_);
}

void LiveSession::fork_from(Kept origin, const Configuration& configuration) {
  write_steps();
  const SegmentStart from = origin.place;
  const Formulation formulation = study::formulation_of(configuration.run);
  origin.state = converted(memory_.system(origin.formulation), origin.state, memory_.system(formulation));
  origin.formulation = formulation;
  origin.place = {++segment_number_, 0};
  memory_.forget_after(origin.step);
  configuration_ = configuration;
  begin_segment(std::move(origin), false, from);
}

void LiveSession::begin_again() {
  write_steps();
  const Formulation formulation = study::formulation_of(configuration_.run);
  const System<double>& system = memory_.system(formulation);
  const State<double> start = system.start();
  const Sample sample{start.t, system.measure(start.y), 0, 0};
  const Kept kept{.state = start,
                  .formulation = formulation,
                  .place = {++segment_number_, 0},
                  .step = 0,
                  .sample = sample,
                  .losses = {},
                  .multipliers = {}};
  memory_.begin(kept);
  begin_segment(kept, true, {});
}

/// Replaces the present segment by a new one. from: its start in the record; fresh: the session starts anew.
void LiveSession::begin_segment(Kept start, bool fresh, SegmentStart from) {
  segment_.place(std::move(start), fresh);
  leaving_ = true;
  playback_.begin_motion();
  collision_.leave();
  past_.reset();
  or_say([&] { recorder_.begin_segment(from, configuration_); });
}

// Publication of views.

void LiveSession::publish() {
  auto view = std::make_shared<View>();
  const Kept& present = segment_.present();
  const Kept& shown = past_ ? *past_ : collision_.state() ? *collision_.state() : present;
  view->frame = memory_.frame(shown);
  or_say([&] {
    if (wanted_.reactions) view->frame.reactions = memory_.reactions(shown);
    const System<double>& system = memory_.system(shown.formulation);
    collision_.show(wanted_, collision_.paused() && !past_, system, shown.state.y, view->frame);
  });
  if (collision_.state() && !past_) view->frame.energy_drift = memory_.energy_drift(present.sample, present.losses);
  view->plot = memory_.plot();
  view->traces = memory_.traces();
  view->status = {.playing = playback_.playing(),
                  .at_end = playback_.at_end(),
                  .failed = playback_.failed(),
                  .paused_at_collision = collision_.paused(),
                  .in_the_past = past_.has_value(),
                  .message = playback_.message().empty() ? trouble_ : playback_.message(),
                  .speed = playback_.pace().speed(),
                  .pace = playback_.pace().pace(),
                  .slower_than_wanted = playback_.pace().slower(),
                  .t_first = memory_.first_time(),
                  .t_last = present.state.t,
                  .t_end = configuration_.run.t_end,
                  .segment = segment_number_};
  view->configuration = configuration_;
  publisher_.publish(std::move(view));
}

std::unique_ptr<Session> live_session(const SessionSetup& setup) { return std::make_unique<LiveSession>(setup); }

}  // namespace polhode::viewer::session
