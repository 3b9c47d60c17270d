// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/metrics/drift_meter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "experiments/study/metrics/drift_class.hpp"

namespace polhode::study::inline metrics {
namespace {

constexpr int exact_instants = 50;
constexpr int most_attitude_errors = 64;

std::optional<double> finite(double x) { return std::isfinite(x) ? std::optional(x) : std::nullopt; }

}  // namespace

void ThinnedSeries::add(const DriftsOfRun& drifts, std::size_t count) {
  const auto [t, energy, linear2, angular2, defect] = drifts;
  for (std::size_t i = 0; i < count;) {
    LargestDrifts<double> largest = {t[i], energy[i], linear2[i], angular2[i], defect[i]};
    const std::size_t begin = i++, end = std::min(count, begin + room());
    for (; i < end; ++i) largest.add(t[i], energy[i], linear2[i], angular2[i], defect[i]);
    add(largest, end - begin);
  }
}

void ThinnedSeries::add(const LargestDrifts<double>& largest, std::size_t count) {
  LargestDrifts<double> all = largest;
  if (in_open_ > 0) {
    all = open_;
    all.add(largest.t, largest.energy, largest.linear2, largest.angular2, largest.defect);
  }
  in_open_ += count;
  if (in_open_ == per_point_) close(all);
  else open_ = all;
}

void ThinnedSeries::close(const LargestDrifts<double>& open) {
  if (points_.empty()) points_.reserve(capacity);
  points_.push_back({open.t, open.energy, open.linear2, open.angular2, open.defect});
  in_open_ = 0;
  if (points_.size() == capacity) merge();
}

void ThinnedSeries::merge() {
  for (std::size_t i = 0; i < capacity / 2; ++i) {
    const SeriesPoint &a = points_[2 * i], &b = points_[2 * i + 1];
    SeriesPoint p = std::abs(a.energy_drift_rel) >= std::abs(b.energy_drift_rel) ? a : b;
    p.linear_momentum_drift_rel = std::max(a.linear_momentum_drift_rel, b.linear_momentum_drift_rel);
    p.angular_momentum_drift_rel = std::max(a.angular_momentum_drift_rel, b.angular_momentum_drift_rel);
    p.orientation_defect = std::max(a.orientation_defect, b.orientation_defect);
    points_[i] = p;
  }
  points_.resize(capacity / 2);
  per_point_ *= 2;
}

std::vector<SeriesPoint> ThinnedSeries::finish(double energy_scale, double linear_scale, double angular_scale) {
  std::vector<SeriesPoint> points;
  points.reserve(points_.size() + 1);  // no more: many runs are kept
  points = points_;
  if (in_open_ > 0) points.push_back({open_.t, open_.energy, open_.linear2, open_.angular2, open_.defect});
  const auto over = [](double drift, double scale) { return scale > 0 ? drift / scale : 0.0; };
  for (SeriesPoint& p : points) {
    p.energy_drift_rel = over(p.energy_drift_rel, energy_scale);
    p.linear_momentum_drift_rel = over(std::sqrt(p.linear_momentum_drift_rel), linear_scale);
    p.angular_momentum_drift_rel = over(std::sqrt(p.angular_momentum_drift_rel), angular_scale);
  }
  return points;
}

DriftMeter::DriftMeter(const System<double>& system, const std::vector<std::string>& invariants, double t_end,
                       bool exact_at_samples, TrueMotion motion, Precision precision)
    : system_(system),
      t_end_(t_end),
      exact_at_samples_(exact_at_samples),
      conserved_(conserved_momenta(system)),
      exact_(system),
      reference_(std::move(motion.reference)),
      has_exact_(exact_.has_anything() || reference_),
      scales_(std::move(motion.scales)),
      precision_(precision),
      polhode_(PolhodeError::of(system, system.moving() == 1 ? exact_.free_top(0) : nullptr)) {
  if (reference_) follower_.emplace(reference_);
  for (const std::string& name : invariants) invariants_.push_back({find_invariant(name)});
}

void DriftMeter::on_start(const State<double>& state, const Sample& sample) {
  const Measurement<double>& m = sample.seen;
  origin_ = {.energy = sample.ledger(0),
             .linear = m.linear_momentum,
             .angular = m.angular_momentum,
             .linear_conserved = conserved_.linear,
             .angular_conserved = conserved_.angular,
             .half = t_end_ / 2,
             .per_t_end = 1 / t_end_};
  if (scales_.energy > 0) origin_.bound = hopeless_drift * scales_.energy;
  for (Watched& w : invariants_) {
    const BodySnapshot<double> body = system_.snapshot(state.y, 0);
    w.start = w.kind->value(system_.problem(), body);
  }
  on_state(state, sample);
}

std::size_t DriftMeter::on_samples(std::span<const Sample> samples) {
  std::size_t taken = 0;
  while (taken < samples.size()) {
    const auto part = samples.subspan(taken, std::min(DriftColumns<double>::most, samples.size() - taken));
    const std::size_t taken_now = take(part);
    taken += taken_now;
    if (taken_now < part.size()) break;
  }
  return taken;
}

/// Takes at most DriftColumns::most samples: the changes of all of them first, then each of the sums and maxima, so
/// that neither waits for the other. A hopeless sample counts, and is the last one.
std::size_t DriftMeter::take(std::span<const Sample> samples) {
  DriftColumns<double> columns;
  const bool several = system_.moving() > 1;
  const bool some_hopeless = fill(columns, samples, origin_, lost_in_contact_, [&](const Sample& sample) {
    Vector3<double> change = sample.seen.angular_momentum - origin_.angular;
    if (several) change -= scales_.mass_center.cross(sample.seen.linear_momentum - origin_.linear);
    return change;
  });
  std::size_t taken = samples.size();
  if (some_hopeless) {
    taken = 0;
    while (!is_hopeless(columns.energy[taken], samples[taken].seen.kinetic, origin_.bound)) ++taken;
  }
  const std::size_t seen = std::min(taken + 1, samples.size());
  follow(DriftsOfRun::in(columns, 0), seen);
  sums_.add(columns, seen, origin_);
  return taken;
}

/// Adds samples to what is kept against time.
void DriftMeter::follow(const DriftsOfRun& drifts, std::size_t count) {
  samples_ += static_cast<std::int64_t>(count);
  if (keeps_curves_) series_.add(drifts, count);
  blocks_.add(drifts.t, drifts.energy, count);
}

double DriftMeter::next_state() const {
  if (measures_invariants() || (has_exact_ && exact_at_samples_)) return 0;
  return has_exact_ ? next_exact_ : std::numeric_limits<double>::infinity();
}

void DriftMeter::on_state(const State<double>& state, const Sample&) {
  if (measures_invariants()) measure_further(state);
  if (!has_exact_ || (!exact_at_samples_ && state.t < next_exact_)) return;
  measure_errors(state);
  plan_next_errors(state.t);
}

/// Sets the time of the next measurement of errors after the one at time t.
void DriftMeter::plan_next_errors(double t) {
  while (next_exact_ <= t) {
    // Slightly early, so that a sample at the instant itself counts in spite of the rounding of its time.
    constexpr double early = 1 - 1e-12;
    next_exact_ = exact_count_ < exact_instants ? early * static_cast<double>(++exact_count_) * t_end_ / exact_instants
                                                : std::numeric_limits<double>::infinity();
  }
}

void DriftMeter::measure_further(const State<double>& state) {
  const BodySnapshot<double> body = system_.snapshot(state.y, 0);
  for (Watched& w : invariants_) raise_size(w.worst, w.kind->value(system_.problem(), body) - w.start);
}

void DriftMeter::measure_errors(const State<double>& state) {
  errors_until_ = state.t;
  ExactMotion::Error e;
  for (std::size_t i = 0; i < system_.moving(); ++i) {
    const BodySnapshot<double> body = system_.snapshot(state.y, i);
    const ExactMotion::BodyError one = exact_.error(state.t, i, body);
    e.raise(one.error);
    if (polhode_) measure_polhode(state.t, body, one.angular_velocity_body);
  }
  if (e.attitude) keep_attitude_error(state.t, *e.attitude);
  if (follower_) {
    const ExactMotion::Error r = follower_->error(system_, state);
    if (!e.position) e.position = r.position;
    if (!e.attitude) e.attitude = r.attitude;
    if (!e.angular_velocity) e.angular_velocity = r.angular_velocity;
  }
  worst_error_.raise(e);
}

void DriftMeter::keep_attitude_error(double t, double error) {
  if (!keeps_curves_) return;
  const double next_kept = t_end_ * static_cast<double>(attitude_errors_.size()) / most_attitude_errors;
  if (t >= next_kept * (1 - 1e-12)) attitude_errors_.push_back({t, error});
}

void DriftMeter::measure_polhode(double t, const BodySnapshot<double>& body,
                                 const std::optional<Vector3<double>>& exact_omega) {
  const PolhodeError::At at = polhode_->at(t, body, exact_omega);
  raise_size(worst_polhode_.phase, at.phase);
  raise_size(worst_polhode_.phase_rad, at.phase_rad);
  raise_size(worst_polhode_.off, at.off);
}

void DriftMeter::report(RunResult& result) {
  result.energy_initial = finite(origin_.energy);
  if (scales_.energy > 0) result.energy_scale = scales_.energy;
  result.energy_round_off = scales_.energy_round_off(precision_, result.steps);
  if (samples_ < 2) return;  // a run that took no step has no drift
  result.energy_drift_max = finite(sums_.worst_energy);
  result.energy_drift_max_rel = finite(sums_.worst_energy / scales_.energy);
  result.energy_drift_final_rel = finite(sums_.last_energy / scales_.energy);
  const double n = static_cast<double>(samples_);
  const double spread = n * sums_.tt - sums_.t * sums_.t;
  if (samples_ > 2 && spread > 0) {
    result.energy_drift_rate = finite((n * sums_.td - sums_.t * sums_.d) / spread / t_end_);
  }
  if (conserved_.linear) result.linear_momentum_drift_max_rel = finite(std::sqrt(sums_.worst_linear2) / scales_.linear);
  if (conserved_.angular)
    result.angular_momentum_drift_max_rel = finite(std::sqrt(sums_.worst_angular2) / scales_.angular);
  for (std::size_t k = 0; k < invariants_.size(); ++k) {
    const auto drift = finite(invariants_[k].worst / scales_.invariants[k]);
    if (drift) result.invariant_drift_max_rel[invariants_[k].kind->name] = *drift;
  }
  result.orientation_defect_max = finite(sums_.worst_defect);
  const auto only_finite = [](const std::optional<double>& x) { return x ? finite(*x) : std::nullopt; };
  result.position_error_max = only_finite(worst_error_.position);
  result.attitude_error_max = only_finite(worst_error_.attitude);
  result.angular_velocity_error_max_rel = only_finite(worst_error_.angular_velocity);
  if (polhode_) {
    result.polhode_phase_error_max = finite(worst_polhode_.phase);
    result.polhode_phase_error_max_rad = finite(worst_polhode_.phase_rad);
    result.polhode_off_error_max_rel = finite(worst_polhode_.off);
  }
  if (reference_) judge_by_reference(result);
  if (keeps_curves_) result.attitude_errors = attitude_errors_;
  // Errors measured before a run broke off, often at its start only, are no measure of its error at the end.
  const bool broke_off = result.status != "ok" && !(errors_until_ >= result.t_reached && result.t_reached > 0);
  if (broke_off) forget_errors(result);
  if (keeps_curves_) result.series = series_.finish(scales_.energy, scales_.linear, scales_.angular);
  if (result.status == "ok") classify(result);
}

void DriftMeter::forget_errors(RunResult& result) {
  result.position_error_max = result.attitude_error_max = result.angular_velocity_error_max_rel = std::nullopt;
  result.polhode_phase_error_max = result.polhode_phase_error_max_rad = result.polhode_off_error_max_rel = std::nullopt;
  result.attitude_errors.clear();
}

void DriftMeter::judge_by_reference(RunResult& result) const {
  constexpr double better = 100;
  const auto judge = [](bool known, double uncertainty, std::optional<double>& error, std::optional<double>& used) {
    if (known) return;
    used = uncertainty;
    if (!(error && *error >= better * uncertainty)) error.reset();
  };
  const ReferenceMotion::Uncertainty& u = reference_->uncertainty();
  bool all_pinned = true;  // if true, no position is measured
  for (std::size_t i = 0; i < system_.moving(); ++i) all_pinned = all_pinned && system_.problem().bodies[i].pinned;
  judge(exact_.has_position() || all_pinned, u.position, result.position_error_max, result.position_reference);
  judge(exact_.has_attitude(), u.attitude, result.attitude_error_max, result.attitude_reference);
  judge(exact_.has_angular_velocity(), u.angular_velocity, result.angular_velocity_error_max_rel,
        result.angular_velocity_reference_rel);
}

void DriftMeter::on_impacts(std::span<const Impact> impacts) {
  constexpr double apart = 1e-3;  // least distance of impacts that are kept, over t_end; shorter than a block
  for (const Impact& impact : impacts) {
    if (impacts_.empty() || impact.t > impacts_.back() + apart * t_end_) impacts_.push_back(impact.t);
  }
}

void DriftMeter::classify(RunResult& result) const {
  DriftRecord record;
  record.blocks = blocks_.finish();
  record.largest = sums_.worst_energy;
  record.largest_early = scales_.energy > 0 ? sums_.worst_early_energy : record.largest;
  record.round_off = result.energy_round_off.value_or(0);
  record.scale = scales_.energy;
  record.samples = samples_;
  record.t_end = t_end_;
  record.impacts = impacts_;
  const DriftClass found = polhode::study::classify(record);
  result.drift_class = found.name;
  result.energy_drift_rate_ci = found.slope_half_width;
  result.drift_exponent = found.exponent;
  result.drift_exponent_low = found.low;
  result.drift_exponent_high = found.high;
  result.drift_decided_after = found.decided_after;
}

}  // namespace polhode::study::metrics
