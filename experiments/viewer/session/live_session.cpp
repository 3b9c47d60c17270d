// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/session/live_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "experiments/study/text/input_error.hpp"
#include "experiments/study/trajectory/trajectory.hpp"
#include "experiments/viewer/session/state_conversion.hpp"

namespace polhode::viewer {
namespace {

constexpr double between_records = 1;  // s of the wall

ContactLosses sum(const ContactLosses& a, const ContactLosses& b) {
  return {a.impact + b.impact, a.friction + b.friction, a.penetration + b.penetration};
}

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
      trajectory_(setup.trajectory),
      memory_(scenario_, setup.history_bytes),
      configuration_(configuration_of(setup, scenario_)) {
  if (!setup.record.empty()) writer_ = std::make_unique<SessionWriter>(setup.record, setup, scenario_);
  begin_again();
  renew_lookout();
  publish();
  thread_ = std::thread([this] { work(); });
}

LiveSession::~LiveSession() { finish(); }

std::string LiveSession::finish() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    news_ = true;
  }
  news_came_.notify_all();
  if (thread_.joinable()) thread_.join();
  return unwritten_;
}

// The window's side.

void LiveSession::send(std::function<void()> command) {
  {
    const std::lock_guard lock(mutex_);
    commands_.push_back(std::move(command));
    news_ = true;
  }
  news_came_.notify_all();
}

std::shared_ptr<const View> LiveSession::view() {
  view_wanted_ = true;
  const std::lock_guard lock(mutex_);
  return view_;
}

void LiveSession::tick(double seconds, double held_back) {
  if (!(seconds > 0)) return;
  {
    const std::lock_guard lock(mutex_);
    ticked_ += seconds;
    held_back_ += held_back;
    news_ = true;
  }
  news_came_.notify_all();
}

double LiveSession::behind() const {
  const std::lock_guard lock(mutex_);
  return std::max(ticked_ - held_back_, 0.0) + behind_;
}

void LiveSession::play() {
  send([this] {
    leave_the_past();
    playing_ = !at_end_;
    paused_at_collision_ = false;
    impact_.reset();
    pace_.forget();
  });
}

void LiveSession::pause() {
  send([this] { halt(); });
}

void LiveSession::step(std::int64_t count) {
  send([this, count] {
    leave_the_past();
    playing_ = paused_at_collision_ = false;
    impact_.reset();
    if (!at_end_) steps_wanted_ += std::max<std::int64_t>(count, 0);
  });
}

void LiveSession::reset() {
  send([this] {
    halt();
    begin_again();
  });
}

void LiveSession::set_speed(double speed) {
  if (!(speed > 0) || !std::isfinite(speed)) throw std::invalid_argument("a speed must be a positive number");
  send([this, speed] { pace_.set_speed(speed); });
}

void LiveSession::scrub(double t) {
  if (std::isnan(t)) return;
  send([this, t] {
    halt();
    paused_at_collision_ = false;
    impact_.reset();
    const Kept& nearest = memory_.nearest(t, present_);
    if (nearest.step == present_.step) past_.reset();
    else past_ = nearest;
  });
}

void LiveSession::pause_on_collision(bool on) {
  send([this, on] {
    pause_on_collision_ = on;
    if (on && lookout_) lookout_->begin(memory_.system(present_.formulation), present_.state.y);
  });
}

void LiveSession::want(const Wanted& wanted) {
  send([this, wanted] {
    wanted_ = wanted;
    memory_.trace(wanted.traced);
  });
}

std::string LiveSession::change(const Configuration& configuration) {
  Configuration c = configuration;
  c.run.scenario = scenario_.name;
  c.run.varied = overrides_;
  if (std::string reason = refusal(c, scenario_); !reason.empty()) return reason;
  send([this, c] {
    fork_from(past_ ? *past_ : present_, c);
    renew_lookout();
  });
  return {};
}

void LiveSession::settle() {
  std::unique_lock lock(mutex_);
  became_idle_.wait(lock, [this] { return idle_ && commands_.empty() && ticked_ == 0; });
}

// The way of the simulation.

void LiveSession::work() {
  while (!quit_) {
    leaving_ = false;
    go_through_segment();
    changed_ = true;
    if (!leaving_ && !quit_) wait();
  }
  record_steps();
}

void LiveSession::go_through_segment() {
  first_look_ = true;
  stop_ = false;
  next_size_ = 0;
  projection_before_ = present_.sample.projection;
  losses_before_ = present_.losses;
  losses_ = {};
  try {
    SegmentRun run(scenario_, configuration_);
    State<double> state = present_.state;
    std::unique_ptr<study::TrajectoryWriter> rows;
    if (!trajectory_.empty()) {
      const auto folder = trajectory_ / fmt::format("segment_{}", segment_);
      rows = study::open_trajectory(study::TrajectoryFormat::csv, folder, run.system(), *this);
    }
    Observer& observer = rows ? static_cast<Observer&>(*rows) : *this;
    finish_segment(run.go(state, observer, stop_, [this] { return next_size_; }));
    if (rows) rows->close();
  } catch (const std::exception& error) {
    if (!trajectory_.empty() && unwritten_.empty()) unwritten_ = error.what();  // whatever it was, the rows have no end
    finish_segment({.status = RunStatus::failed, .message = error.what()});
  }
}

void LiveSession::finish_segment(const RunOutcome& outcome) {
  if (outcome.status == RunStatus::interrupted) return;
  at_end_ = true;
  failed_ = outcome.status != RunStatus::ok;
  message_ = outcome.message;
  if (!failed_ && present_.state.t < configuration_.run.t_end) message_ = "the run ends at its first impact";
  halt();
}

std::size_t LiveSession::observe(std::span<const Sample> samples) {
  std::size_t taken = 0;
  for (; taken < samples.size(); ++taken) {
    Sample sample = samples[taken];
    sample.projection += projection_before_;
    if (first_look_) continue;
    if (memory_.hopeless(memory_.energy_drift(sample, sum(losses_before_, losses_))) ||
        memory_.hopeless(sample.seen.kinetic))
      break;
  }
  return taken;
}

void LiveSession::account(const ContactLosses& losses) { losses_ = losses; }

void LiveSession::look(const State<double>& state, const Sample& sample) {
  std::swap(before_, present_.state);
  present_.state = state;
  present_.sample = sample;
  present_.sample.projection += projection_before_;
  present_.losses = sum(losses_before_, losses_);
  if (first_look_) {
    first_look_ = false;
    if (fresh_) memory_.begin(present_);
    fresh_ = false;
    if (pause_on_collision_ && lookout_) lookout_->begin(memory_.system(present_.formulation), state.y);
  } else {
    ++present_.step;
    ++present_.place.step;
    if (configuration_.drive == Drive::frame_clock) unrecorded_sizes_.push_back(next_size_);
    memory_.add(present_);
    const double went = state.t - before_.t;
    pace_.went(went);
    if (playing_ && !configuration_.run.dt) pace_.took(went);
    if (pause_on_collision_ && lookout_) or_say([this] { watch_collisions(); });
  }
  impacts_.clear();
  changed_ = true;
  if (view_wanted_.exchange(false)) publish();
  wait();
}

/// Until the next step may be taken, or the segment is left.
void LiveSession::wait() {
  for (;;) {
    apply_news();
    if (quit_ || leaving_) {
      stop_ = true;
      return;
    }
    if (may_step()) return;
    if (!playing_) record_steps();
    if (changed_) publish();
    std::unique_lock lock(mutex_);
    if (news_) continue;
    idle_ = true;
    behind_ = 0;
    became_idle_.notify_all();
    news_came_.wait(lock, [this] { return news_.load(); });
    idle_ = false;
  }
}

void LiveSession::apply_news() {
  if (!news_.load(std::memory_order_relaxed)) return;
  std::vector<std::function<void()>> commands;
  double seconds = 0, held_back = 0;
  {
    const std::lock_guard lock(mutex_);
    news_ = false;
    commands.swap(commands_);
    seconds = std::exchange(ticked_, 0);
    held_back = std::exchange(held_back_, 0);
    behind_ = playing_ ? pace_.behind() + std::max(seconds - held_back, 0.0) : 0;
  }
  for (const auto& command : commands) or_say(command);
  if (seconds > 0) pass_time(seconds, held_back);
  if (commands.empty()) return;
  record_steps();
  changed_ = true;
}

void LiveSession::pass_time(double seconds, double held_back) {
  if (!playing_ || at_end_) return;
  pace_.tick(seconds, configuration_.run.dt.value_or(0), held_back);
  since_record_ += seconds;
  if (since_record_ >= between_records) record_steps();
}

bool LiveSession::may_step() {
  if (at_end_) return false;
  next_size_ = configuration_.run.dt.value_or(0);
  if (steps_wanted_ > 0) {
    --steps_wanted_;
    return true;
  }
  if (!playing_) return false;
  if (!configuration_.run.dt) return pace_.owes();
  if (configuration_.drive == Drive::accumulator) return pace_.take(next_size_);
  next_size_ = pace_.take_all();
  return next_size_ > 0;
}

/// What goes wrong beside the motion ends neither it nor the thread.
template <class F>
void LiveSession::or_say(const F& act) {
  try {
    act();
  } catch (const std::exception& error) {
    trouble_ = error.what();
  }
}

void LiveSession::halt() {
  playing_ = false;
  steps_wanted_ = 0;
  pace_.forget();
}

void LiveSession::leave_the_past() {
  if (past_) fork_from(*past_, configuration_);
}

void LiveSession::fork_from(Kept origin, const Configuration& configuration) {
  record_steps();
  const SegmentStart from = origin.place;
  const Formulation& formulation = configuration.run.formulation;
  origin.state = converted(memory_.system(origin.formulation), origin.state, memory_.system(formulation));
  origin.formulation = formulation;
  origin.place = {++segment_, 0};
  memory_.forget_after(origin.step);
  present_ = std::move(origin);
  configuration_ = configuration;
  leave_for_new();
  record_segment(from);
}

void LiveSession::begin_again() {
  record_steps();
  const Formulation& formulation = configuration_.run.formulation;
  const System<double>& system = memory_.system(formulation);
  const State<double> start = system.start();
  const Sample sample{start.t, system.measure(start.y), 0, 0};
  present_ = {
      .state = start, .formulation = formulation, .place = {++segment_, 0}, .step = 0, .sample = sample, .losses = {}};
  memory_.begin(present_);
  fresh_ = true;
  leave_for_new();
  record_segment({});
}

void LiveSession::leave_for_new() {
  leaving_ = true;
  at_end_ = failed_ = paused_at_collision_ = false;
  message_.clear();
  past_.reset();
  impact_.reset();
}

// Collisions.

void LiveSession::renew_lookout() {
  if (configuration_.run.contact) lookout_.emplace(scenario_, *configuration_.run.contact);
}

void LiveSession::watch_collisions() {
  const System<double>& system = memory_.system(present_.formulation);
  const std::vector<BodyPair> met = lookout_->newly_met(system, present_.state.y, impacts_);
  if (met.empty()) return;
  halt();
  paused_at_collision_ = true;
  impact_ = at_impact(met);
  const Kept& shown = impact_ ? *impact_ : present_;
  impact_contacts_ = lookout_->contacts(system, shown.state.y);
  if (!impact_contacts_.empty()) return;
  for (const Impact& i : impacts_) {
    if (!impact_ || i.t <= impact_->state.t) impact_contacts_.push_back({i.a, i.b, i.point, i.normal, 0});
  }
}

/// The state at the first impact of these pairs within the last step, for the eye: flown there from where the step
/// began by the same method, apart from the run, which has gone on.
std::optional<Kept> LiveSession::at_impact(std::span<const BodyPair> met) {
  double t = present_.state.t;
  for (const Impact& i : impacts_) {
    const BodyPair pair{static_cast<std::uint32_t>(i.a), static_cast<std::uint32_t>(i.b)};
    if (std::find(met.begin(), met.end(), pair) != met.end()) t = std::min(t, i.t);
  }
  if (!(t < present_.state.t) || !(t > before_.t)) return std::nullopt;
  const System<double>& system = memory_.system(present_.formulation);
  const auto method = study::integrator_of<double>(configuration_.run, system);
  Kept there = present_;
  there.state = before_;
  method->begin(there.state);
  const double close = 1e-15 * t;  // nearer than that some methods cannot start
  while (t - there.state.t > close) {
    if (!method->step(there.state, t - there.state.t).ok()) return std::nullopt;
  }
  there.state.t = t;
  there.sample.seen = system.measure(there.state.y);
  return there;
}

// What is seen.

void LiveSession::publish() {
  auto view = std::make_shared<View>();
  const Kept& shown = past_ ? *past_ : impact_ ? *impact_ : present_;
  view->frame = memory_.frame(shown);
  or_say([&] {
    const System<double>& system = memory_.system(shown.formulation);
    if (paused_at_collision_ && !past_) view->frame.contacts = impact_contacts_;
    else if (wanted_.contacts && lookout_) view->frame.contacts = lookout_->contacts(system, shown.state.y);
    if (wanted_.cells && lookout_) view->frame.cells = lookout_->cells(system, shown.state.y);
  });
  if (impact_ && !past_) view->frame.energy_drift = memory_.energy_drift(present_.sample, present_.losses);
  view->plot = memory_.plot();
  view->traces = memory_.traces();
  view->status = {.playing = playing_,
                  .at_end = at_end_,
                  .failed = failed_,
                  .paused_at_collision = paused_at_collision_,
                  .in_the_past = past_.has_value(),
                  .message = message_.empty() ? trouble_ : message_,
                  .speed = pace_.speed(),
                  .pace = pace_.pace(),
                  .slower_than_wanted = pace_.slower(),
                  .t_first = memory_.first_time(),
                  .t_last = present_.state.t,
                  .t_end = configuration_.run.t_end,
                  .segment = segment_};
  view->configuration = configuration_;
  changed_ = false;
  const std::lock_guard lock(mutex_);
  view_ = std::move(view);
}

// What is recorded.

template <class F>
void LiveSession::record(const F& write) {
  if (!writer_) return;
  try {
    write();
  } catch (const std::exception& error) {
    trouble_ = fmt::format("the session is no longer recorded: {}", error.what());
    if (unwritten_.empty()) unwritten_ = trouble_;
    writer_.reset();
  }
}

void LiveSession::record_segment(SegmentStart from) {
  recorded_steps_ = 0;
  unrecorded_sizes_.clear();
  record([&] { writer_->begin(from, configuration_); });
}

void LiveSession::record_steps() {
  since_record_ = 0;
  const std::int64_t steps = present_.place.step - recorded_steps_;
  if (steps > 0) record([&] { writer_->add({steps, unrecorded_sizes_, digest(present_.state)}); });
  recorded_steps_ = present_.place.step;
  unrecorded_sizes_.clear();
}

std::unique_ptr<Session> live_session(const SessionSetup& setup) { return std::make_unique<LiveSession>(setup); }

}  // namespace polhode::viewer
