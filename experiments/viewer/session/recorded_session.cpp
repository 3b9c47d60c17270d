// SPDX-License-Identifier: BSD-3-Clause
// A session that plays a recorded trajectory. It needs no thread, since it only looks up samples by time.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "experiments/study/text/csv_reader.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/trajectory/reaction_reader.hpp"
#include "experiments/study/trajectory/trajectory_reader.hpp"
#include "experiments/viewer/session/contact_lookout.hpp"
#include "experiments/viewer/session/reactions.hpp"
#include "experiments/viewer/session/session.hpp"
#include "experiments/viewer/session/state_conversion.hpp"

namespace polhode::viewer::inline session {
namespace {

constexpr std::size_t most_points = 2048;

/// Spherical interpolation between unit quaternions on the shorter arc; s = 0: a, s = 1: b. Source: Shoemake, Animating
/// rotation with quaternion curves, 1985.
Quaternion<double> slerp(const Quaternion<double>& a, const Quaternion<double>& b, double s) {
  const Quaternion<double> to = a.dot(b) < 0 ? Quaternion<double>(-b) : b;
  const double angle = 2 * std::atan2((to - a).norm(), (to + a).norm());
  if (angle < 1e-8) return (a + s * (to - a)).normalized();
  return ((std::sin((1 - s) * angle) * a + std::sin(s * angle) * to) / std::sin(angle)).normalized();
}

class RecordedSession final : public Session {
 public:
  RecordedSession(const std::string& trajectory, const std::string& scenario,
                  const std::vector<study::Override>& overrides, Between between)
      : scenario_(study::ScenarioSource::open(scenario).resolve(overrides)),
        between_(between),
        motion_(study::read_trajectory(trajectory, scenario_.problem)),
        system_(make_system<double>(scenario_.problem, {})) {
    configuration_ = usual_configuration(scenario_);
    configuration_.run.varied = overrides;
    configuration_.run.t_end = motion_.times.back();
    if (configuration_.run.contact) lookout_.emplace(scenario_, *configuration_.run.contact);
    t_ = motion_.times.front();
    forces_ = study::read_reactions(std::filesystem::path(trajectory).parent_path(), motion_.times,
                                    scenario_.problem.joints.size());
    measure(trajectory);
  }

  const study::Scenario& scenario() const override { return scenario_; }

  std::shared_ptr<const View> view() override {
    if (!view_) view_ = make_view();
    return view_;
  }

  void tick(double seconds, double held_back) override {
    if (!playing_ || !(seconds > held_back)) return;
    go_to(t_ + (seconds - held_back) * speed_);
    if (t_ == motion_.times.back()) playing_ = false;
  }
  double behind() const override { return 0; }
  void play() override { change_to(t_ < motion_.times.back()); }
  void pause() override { change_to(false); }
  void step(std::int64_t count) override {
    change_to(false);
    const auto left = motion_.times.size() - 1 - sample_;
    go_to(motion_.times[sample_ + std::min(left, static_cast<std::size_t>(std::max<std::int64_t>(count, 0)))]);
  }
  void reset() override { scrub(motion_.times.front()); }
  void set_speed(double speed) override {
    if (!(speed > 0) || !std::isfinite(speed)) throw std::invalid_argument("a speed must be a positive number");
    speed_ = speed;
    view_.reset();
  }
  void scrub(double t) override {
    change_to(false);
    if (!std::isnan(t)) go_to(t);
  }
  void pause_on_collision(bool on) override {
    pause_on_collision_ = on;
    if (on && lookout_) lookout_->begin(*system_, state_at(sample_, 0));
  }
  void want(const Wanted& wanted) override {
    wanted_ = wanted;
    view_.reset();
  }
  std::string change(const Configuration&) override {
    return "a recorded trajectory is as it is; open the scenario to change it";
  }
  void settle() override {}

 private:
  void change_to(bool playing) {
    playing_ = playing;
    collided_ = false;
    view_.reset();
  }

  /// Goes to time t (s); sample by sample if the session plays and pauses at collisions.
  void go_to(double t) {
    const std::vector<double>& times = motion_.times;
    t = std::clamp(t, times.front(), times.back());
    auto reached = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), t) - times.begin()) - 1;
    if (pause_on_collision_ && lookout_ && playing_) {
      for (std::size_t k = sample_ + 1; k <= reached; ++k) {
        if (lookout_->newly_met(*system_, state_at(k, 0), {}).empty()) continue;
        t = times[k];
        reached = k;
        playing_ = false;
        collided_ = true;
      }
    } else if (pause_on_collision_ && lookout_) {
      lookout_->begin(*system_, state_at(reached, 0));
    }
    t_ = t;
    sample_ = reached;
    view_.reset();
  }

  const BodySnapshot<double>& body(std::size_t sample, std::size_t i) const {
    return motion_.bodies[sample * motion_.moving + i];
  }
  Quaternion<double> orientation(std::size_t sample, std::size_t i) const {
    return body(sample, i).orientation.normalized();
  }

  /// State interpolated between samples k and k + 1 at the fraction s (0 to 1).
  VectorX<double> state_at(std::size_t k, double s) const {
    const std::size_t next = s > 0 ? k + 1 : k;
    VectorX<double> y = VectorX<double>::Zero(system_->layout().size());
    for (std::size_t i = 0; i < motion_.moving; ++i) {
      const BodySnapshot<double>&a = body(k, i), &b = body(next, i);
      BodySnapshot<double> at;
      const auto mean = [s](const Vector3<double>& x, const Vector3<double>& z) {
        return Vector3<double>((1 - s) * x + s * z);
      };
      at.position = mean(a.position, b.position);
      at.velocity = mean(a.velocity, b.velocity);
      at.angular_velocity = mean(a.angular_velocity, b.angular_velocity);
      at.angular_momentum = mean(a.angular_momentum, b.angular_momentum);
      at.orientation = s > 0 ? slerp(orientation(k, i), orientation(next, i), s) : orientation(k, i);
      at.rotation = rotation_matrix<double>(at.orientation);
      write_body(*system_, at, i, y);
    }
    return y;
  }

  double defect(std::size_t sample) const {
    double worst = 0;
    for (std::size_t i = 0; i < motion_.moving; ++i) {
      const BodySnapshot<double>& b = body(sample, i);
      const double now = motion_.has_matrix ? (b.rotation.transpose() * b.rotation - Matrix3<double>::Identity()).norm()
                                            : std::abs(b.orientation.norm() - 1);
      worst = std::max(worst, now);
    }
    return worst;
  }

  PlotPoint measured(double t, const VectorX<double>& y, std::size_t sample) const {
    const Measurement<double> m = system_->measure(y);
    const double energy = motion_.has_energy ? motion_.energy[sample] : m.energy();
    return {t,
            m.kinetic,
            m.potential,
            drift_.empty() ? energy - energy_start_ : drift_[sample],
            (m.angular_momentum - momentum_start_).norm(),
            defect(sample)};
  }

  /// Reads the energy drift of the run from energy.csv beside the trajectory, if that file has a row for each instant;
  /// otherwise the drift is the change of the energy.
  void read_ledger(const std::string& trajectory) {
    const std::filesystem::path path = std::filesystem::path(trajectory).parent_path() / "energy.csv";
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return;
    study::CsvReader rows(path.string());
    const std::size_t t = rows.column("t_s"), drift = rows.column("drift_J");
    std::vector<double> all;
    while (rows.next()) {
      if (all.size() == motion_.times.size() || rows.number(t) != motion_.times[all.size()]) return;
      all.push_back(rows.number(drift));
    }
    if (all.size() == motion_.times.size()) drift_ = std::move(all);
  }

  void measure(const std::string& trajectory) {
    read_ledger(trajectory);
    const Measurement<double> start = system_->measure(state_at(0, 0));
    momentum_start_ = start.angular_momentum;
    energy_start_ = motion_.has_energy ? motion_.energy[0] : start.energy();
    const std::size_t stride = (motion_.times.size() + most_points - 1) / most_points;
    for (std::size_t k = 0; k < motion_.times.size(); k += stride) {
      plot_.push_back(measured(motion_.times[k], state_at(k, 0), k));
    }
  }

  std::shared_ptr<const View> make_view() {
    const std::vector<double>& times = motion_.times;
    double s = 0;
    std::size_t k = sample_;
    if (k + 1 < times.size()) s = (t_ - times[k]) / (times[k + 1] - times[k]);
    if (between_ == Between::nearest) {
      if (s >= 0.5) ++k;
      s = 0;
    }
    const VectorX<double> y = state_at(k, s);
    auto view = std::make_shared<View>();
    const PlotPoint point = measured(t_, y, k);
    Frame& frame = view->frame;
    frame.t = between_ == Between::nearest ? times[k] : t_;
    frame.step = static_cast<std::int64_t>(k);
    frame.kinetic = point.kinetic;
    frame.potential = point.potential;
    frame.energy_drift = point.energy_drift;
    frame.momentum_drift = point.momentum_drift;
    frame.defect = point.defect;
    for (std::size_t i = 0; i < motion_.moving; ++i) {
      frame.bodies.push_back(system_->snapshot(y, i));
    }
    if (lookout_ && (wanted_.contacts || collided_)) frame.contacts = lookout_->contacts(*system_, y);
    if (wanted_.reactions) frame.reactions = reactions(k, s, y);
    if (lookout_ && wanted_.cells) frame.cells = lookout_->cells(*system_, y);
    view->plot = plot_;
    for (const std::size_t i : wanted_.traced) {
      if (i < motion_.moving) view->traces.push_back(trace(i));
    }
    view->status = {.playing = playing_,
                    .at_end = t_ == times.back(),
                    .failed = false,
                    .paused_at_collision = collided_,
                    .in_the_past = false,
                    .message = {},
                    .speed = speed_,
                    .pace = playing_ ? speed_ : 0,
                    .slower_than_wanted = false,
                    .t_first = times.front(),
                    .t_last = times.back(),
                    .t_end = times.back(),
                    .segment = 1};
    view->configuration = configuration_;
    return view;
  }

  /// The recorded forces, or those that follow from the state y, which lies between samples k and k + 1 at the
  /// fraction s.
  std::vector<FrameReaction> reactions(std::size_t k, double s, const VectorX<double>& y) const {
    std::vector<FrameReaction> all = reactions_of(*system_, {.t = t_, .y = y});
    const std::size_t next = s > 0 ? k + 1 : k;
    for (std::size_t i = 0; i < all.size() && !forces_.empty(); ++i)
      all[i].force = (1 - s) * forces_[k * all.size() + i] + s * forces_[next * all.size() + i];
    return all;
  }

  Trace trace(std::size_t i) const {
    Trace out{i, {}};
    const std::size_t stride = (sample_ + most_points) / most_points;
    for (std::size_t k = 0; k <= sample_; k += stride) {
      const Matrix3<double> r = rotation_matrix<double>(orientation(k, i));
      out.points.push_back({motion_.times[k], body(k, i).position, r.transpose() * body(k, i).angular_velocity});
    }
    return out;
  }

  const study::Scenario scenario_;
  const Between between_;
  const study::Trajectory motion_;
  const std::unique_ptr<System<double>> system_;
  std::optional<ContactLookout> lookout_;
  Configuration configuration_;
  Wanted wanted_;
  Vector3<double> momentum_start_ = Vector3<double>::Zero();
  double energy_start_ = 0;
  std::vector<double> drift_;            ///< energy drift at each instant, J; empty: unknown
  std::vector<Vector3<double>> forces_;  ///< forces of the joints at each instant, N; empty: not recorded
  std::vector<PlotPoint> plot_;
  double t_ = 0, speed_ = 1;
  std::size_t sample_ = 0;  ///< index of the last sample at or before t_
  bool playing_ = false, pause_on_collision_ = false, collided_ = false;
  std::shared_ptr<const View> view_;
};

}  // namespace

std::unique_ptr<Session> recorded_session(const std::string& trajectory, const std::string& scenario,
                                          const std::vector<study::Override>& overrides, Between between) {
  return std::make_unique<RecordedSession>(trajectory, scenario, overrides, between);
}

}  // namespace polhode::viewer::session
