// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/trajectory_score.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>

#include "experiments/study/metrics/drift_meter.hpp"
#include "experiments/study/metrics/polhode_error.hpp"

namespace polhode::study::judge {
namespace {

constexpr std::size_t most_error_points = 256;

/// The states of a trajectory in the layout of a system, with quantities that the file lacks computed from the others.
class States {
 public:
  States(const Trajectory& trajectory, const System<double>& system, const ExactMotion& exact)
      : trajectory_(trajectory), system_(system), exact_(exact) {
    for (std::size_t i = 0; i < system.moving(); ++i) any_path_ = any_path_ || !system.problem().bodies[i].pinned;
  }

  bool any_path() const { return any_path_; }
  bool path_from_exact() const {
    return any_path_ && exact_.has_position() && !(trajectory_.has_position && trajectory_.has_velocity);
  }
  bool knows_position() const { return trajectory_.has_position || !any_path_ || exact_.has_position(); }
  bool knows_velocity() const { return trajectory_.has_velocity || !any_path_ || exact_.has_position(); }
  bool knows_rotation() const { return trajectory_.has_angular_velocity || trajectory_.has_angular_momentum; }

  /// The k-th state, with the work done since the start.
  State<double> at(std::size_t k, double work) const {
    State<double> state = system_.start();
    state.t = trajectory_.times[k];
    for (std::size_t i = 0; i < trajectory_.moving; ++i) {
      const BodySnapshot<double>& body = trajectory_.bodies[k * trajectory_.moving + i];
      const Layout::Slot slot = system_.layout().slots[i];
      double* y = state.y.data();
      Matrix3<double> rotation = body.rotation;
      if (trajectory_.has_matrix) {
        Eigen::Map<Matrix3<double>>{y + slot.orientation} = body.rotation;
      } else {
        Eigen::Map<Quaternion<double>>{y + slot.orientation} = body.orientation;
        if (system_.formulation().rotation_from == RotationFrom::stored) {
          rotation = rotation_matrix_stored(body.orientation);
        }
      }
      Vector3<double> omega = body.angular_velocity;
      if (!trajectory_.has_angular_velocity && trajectory_.has_angular_momentum) {
        const Matrix3<double>& inertia = system_.problem().bodies[i].inertia;
        omega = rotation * inertia.ldlt().solve(rotation.transpose() * body.angular_momentum);
      }
      Eigen::Map<Vector3<double>>{y + slot.angular} = omega;
      if (slot.position < 0) continue;
      Vector3<double> position = body.position, velocity = body.velocity;
      if (const auto path = path_from_exact() ? exact_.at(state.t, i).path : std::nullopt) {
        if (!trajectory_.has_position) position = path->position;
        if (!trajectory_.has_velocity) velocity = path->velocity;
      }
      Eigen::Map<Vector3<double>>{y + slot.position} = position;
      Eigen::Map<Vector3<double>>{y + slot.velocity} = velocity;
    }
    state.y[system_.layout().work()] = work;
    return state;
  }

 private:
  const Trajectory& trajectory_;
  const System<double>& system_;
  const ExactMotion& exact_;
  bool any_path_ = false;
};

double power_of(const System<double>& system, const State<double>& state) {
  VectorX<double> rate(state.y.size());
  system.rate(state.t, state.y.data(), rate.data());
  return rate[system.layout().work()];
}

/// Removes the results that the columns of the file do not determine, and adds a note about them.
void blank(const States& states, const Trajectory& trajectory, const System<double>& system, TrajectoryScore& score) {
  RunResult& r = score.record.result;
  const auto drop = [](auto&... values) { (values.reset(), ...); };
  std::vector<std::string>& notes = score.notes;
  const bool all_bodies_alone = system.moving() == 1;
  bool energy = true, angular = true;
  if (!states.knows_rotation()) {
    energy = angular = false;
    r.invariant_drift_max_rel.clear();
    drop(r.angular_velocity_error_max_rel, r.polhode_phase_error_max, r.polhode_phase_error_max_rad,
         r.polhode_off_error_max_rel);
    notes.emplace_back(
        "it has no angular velocity (wx_rad_per_s …) and no angular momentum (lx_kg_m2_per_s …): energy, "
        "angular momentum, invariants and polhode are left out");
  } else if (!trajectory.has_angular_velocity) {
    notes.emplace_back("it has no angular velocity: R I⁻¹ Rᵀ L stands for it");
  }
  if (states.any_path() && !trajectory.has_position) drop(r.position_error_max);
  if (states.any_path() && !trajectory.has_velocity) drop(r.linear_momentum_drift_max_rel);
  if (states.path_from_exact()) {
    notes.emplace_back(
        fmt::format("it has no {}: the exact motion of the mass centre stands for it, and its energy is "
                    "judged with that",
                    trajectory.has_position   ? "velocity"
                    : trajectory.has_velocity ? "position"
                                              : "position and velocity"));
  } else if (!states.knows_position() || !states.knows_velocity()) {
    energy = false;
    angular = angular && all_bodies_alone;
    notes.emplace_back("it lacks position or velocity, and no exact path stands for them: energy is left out");
  }
  if (!energy) {
    drop(r.energy_initial, r.energy_drift_max, r.energy_round_off, r.energy_drift_max_rel, r.energy_drift_final_rel,
         r.energy_drift_rate, r.energy_drift_rate_ci, r.drift_exponent, r.drift_exponent_low, r.drift_exponent_high,
         r.drift_decided_after, score.energy_column_difference_max_rel);
    r.drift_class.clear();
    for (SeriesPoint& p : r.series) p.energy_drift_rel = 0;
  }
  if (!angular) drop(r.angular_momentum_drift_max_rel);
  for (ErrorPoint& p : score.errors) {
    if (!r.position_error_max) p.position.reset();
    if (!r.attitude_error_max) p.attitude.reset();
    if (!r.angular_velocity_error_max_rel) p.angular_velocity.reset();
    if (!r.polhode_off_error_max_rel) p.phase.reset(), p.off.reset();
  }
}

/// Adds a note if the first row differs from the scenario's start, which affects every score.
void compare_start(const System<double>& system, const State<double>& first, const Trajectory& trajectory,
                   std::vector<std::string>& notes) {
  constexpr double negligible = 1e-5;  // relative difference, above that of numbers in single precision
  if (first.t != 0) {
    notes.emplace_back(fmt::format("its first row is at t = {:.6g} s: drifts are against that row", first.t));
    return;
  }
  const State<double> start = system.start();
  for (std::size_t i = 0; i < system.moving(); ++i) {
    const BodySnapshot<double> a = system.snapshot(first.y, i), b = system.snapshot(start.y, i);
    const auto differ = [&](const char* what, double by, const char* unit) {
      notes.emplace_back(fmt::format("body {} starts with {} {:.3g}{} away from the scenario's: errors contain that", i,
                                     what, by, unit));
    };
    const double angle = angle_between(a.orientation, b.orientation);
    if (angle > negligible) differ("an attitude", angle, " rad");
    const double omega = (a.angular_velocity - b.angular_velocity).norm();
    if ((trajectory.has_angular_velocity || trajectory.has_angular_momentum) &&
        omega > negligible * std::max(b.angular_velocity.norm(), 1e-3)) {
      differ("an angular velocity", omega, " rad/s");
    }
    if (system.problem().bodies[i].pinned) continue;
    const double distance = (a.position - b.position).norm(), speed = (a.velocity - b.velocity).norm();
    if (trajectory.has_position && distance > negligible * (1 + b.position.norm()))
      differ("a position", distance, " m");
    if (trajectory.has_velocity && speed > negligible * (1 + b.velocity.norm())) differ("a velocity", speed, " m/s");
  }
}

}  // namespace

std::string identity_of(std::string_view text) { return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size())); }

TrajectoryScore score(const Trajectory& trajectory, const Scenario& scenario, RunConfig config, References* references,
                      const std::atomic<bool>* stop) {
  TrajectoryScore result;
  const std::size_t n = trajectory.times.size();
  config.formulation.orientation = trajectory.has_matrix ? Orientation::matrix : Orientation::quaternion;
  config.formulation.angular_state = AngularState::velocity_world;
  config.t_end = trajectory.times.back();
  double spacing = 0;
  for (std::size_t k = 1; k < n; ++k) spacing = std::max(spacing, trajectory.times[k] - trajectory.times[k - 1]);
  config.dt = spacing;
  const auto system = make_system<double>(scenario.problem, config.formulation);
  const ExactMotion exact(*system);
  References own;
  const TrueMotion truth = (references ? *references : own).of(config, scenario, stop);
  const auto reference = truth.reference;
  DriftMeter meter(*system, scenario.invariants, config.t_end, true, truth);
  std::optional<ReferenceMotion::Follower> follower;
  if (reference) follower.emplace(reference);
  auto polhode = PolhodeError::of(*system);
  const States states(trajectory, *system, exact);

  result.instants = n;
  result.t_first = trajectory.times.front();
  const bool working = std::any_of(system->forces().begin(), system->forces().end(),
                                   [](const auto& force) { return force->does_work(); });
  const std::size_t stride = (n + most_error_points - 1) / most_error_points;
  double work = 0, power = 0, worst_difference = 0;
  RunResult& r = result.record.result;
  r.status = "ok";
  r.steps = static_cast<std::int64_t>(n) - 1;
  for (std::size_t k = 0; k < n; ++k) {
    State<double> state = states.at(k, work);
    if (working) {  // the trapezoidal rule over the rows
      const double now = power_of(*system, state);
      if (k > 0) work += (trajectory.times[k] - trajectory.times[k - 1]) * (power + now) / 2;
      power = now;
      state.y[system->layout().work()] = work;
    }
    if (k == 0) compare_start(*system, state, trajectory, result.notes);
    const Sample sample{state.t, system->measure(state.y), work, 0};
    if (k == 0) meter.on_start(state, sample);
    else meter.on_state(state, sample);
    r.t_reached = state.t;
    if (meter.on_samples({&sample, 1}) != 1) {
      r.status = "diverged";
      r.message = fmt::format("the energy grew beyond all bounds at t = {:.12g} s", state.t);
      break;
    }
    if (trajectory.has_energy) {
      const double difference = std::abs(trajectory.energy[k] - sample.seen.energy());
      if (!(difference <= worst_difference)) worst_difference = difference;
    }
    ErrorPoint point;
    point.t = state.t;
    if (polhode) {  // at every row, since the phase is tracked from row to row
      const PolhodeError::At at = polhode->at(state.t, system->snapshot(state.y, 0));
      point.phase = at.phase;
      point.off = at.off;
    }
    if (k % stride != 0 && k + 1 != n) continue;
    ExactMotion::Error e = exact.error(*system, state);
    if (follower) {
      const ExactMotion::Error by_reference = follower->error(*system, state);
      if (!e.position) e.position = by_reference.position;
      if (!e.attitude) e.attitude = by_reference.attitude;
      if (!e.angular_velocity) e.angular_velocity = by_reference.angular_velocity;
    }
    point.position = e.position;
    point.attitude = e.attitude;
    point.angular_velocity = e.angular_velocity;
    result.errors.push_back(point);
  }
  meter.report(r);
  if (trajectory.has_energy) result.energy_column_difference_max_rel = worst_difference / meter.energy_scale();
  if (working)
    result.notes.emplace_back("the work of forces without a potential is summed by the trapezoidal rule over its rows");
  result.record.config = std::move(config);
  blank(states, trajectory, *system, result);
  return result;
}

}  // namespace polhode::study::judge
