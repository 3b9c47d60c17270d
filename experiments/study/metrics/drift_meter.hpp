// SPDX-License-Identifier: BSD-3-Clause
// Measures the drift of the invariants during a run, and the errors against the exact motion.
//
// The energy is a balance (ledger): E = kinetic + potential − work of non-conservative forces + energy lost in contact
// − energy injected by projection. Its drift E − E(0) is the numerical error of the energy. Relative drifts are drifts
// over the scales of the motion (motion_scales.hpp).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/exact/exact_motion.hpp"
#include "core/exact/reference_motion.hpp"
#include "core/run/simulate.hpp"
#include "core/system/invariants.hpp"
#include "experiments/study/metrics/drift_sums.hpp"
#include "experiments/study/metrics/polhode_error.hpp"
#include "experiments/study/metrics/references.hpp"
#include "experiments/study/record/run_record.hpp"
#include "experiments/study/statistics/drift_growth.hpp"
#include "experiments/study/statistics/strided.hpp"

namespace polhode::study::inline metrics {

/// History of a run in at most 256 intervals of equally many samples; when all are in use, neighbours are merged.
class ThinnedSeries {
 public:
  /// Adds `count` samples. Energies and momenta in any units.
  void add(const DriftsOfRun& drifts, std::size_t count);

  /// Number of samples that complete the open interval.
  std::size_t room() const { return per_point_ - in_open_; }
  /// Adds `count` samples, at most room(), by the largest of them.
  void add(const LargestDrifts<double>& largest, std::size_t count);
  /// The history, with drifts relative to these scales (in the units of add()); 0 where a scale is 0.
  std::vector<SeriesPoint> finish(double energy_scale, double linear_scale, double angular_scale);

 private:
  static constexpr std::size_t capacity = 256;
  void close(const LargestDrifts<double>& open);
  void merge();

  std::vector<SeriesPoint> points_;
  LargestDrifts<double> open_;
  std::size_t in_open_ = 0;
  std::size_t per_point_ = 1;  ///< samples in one interval
};

class DriftMeter final : public Observer {
 public:
  /// invariants: names of further declared invariants; t_end: duration of the run, s.
  /// exact_at_samples: measure the errors against the exact motion at every sample; otherwise at 50 instants spread
  /// evenly over the run (at the first sample at or after each) and at its end, since each costs more than a step.
  /// motion.reference: replaces exact solutions that are unknown; may be null.
  /// precision: arithmetic of the run.
  DriftMeter(const System<double>& system, const std::vector<std::string>& invariants, double t_end,
             bool exact_at_samples, TrueMotion motion, Precision precision = Precision::double_precision);

  void on_start(const State<double>& state, const Sample& sample) override;
  std::size_t on_samples(std::span<const Sample> samples) override;
  void on_state(const State<double>& state, const Sample& sample) override;
  double next_state() const override;
  void on_contact_energy(const ContactLosses& losses) override { lost_in_contact_ = losses.total(); }
  void on_impacts(std::span<const Impact> impacts) override;

  /// Invariants are measured in lanes (LaneMeter). To be called before the run.
  void expect_invariants() { invariants_told_ = true; }

  /// The result is to have no curves against time. To be called before the run.
  void leave_out_curves() { keeps_curves_ = false; }

  /// Scale of the energy drift, J; 0: nothing moves, and there are no relative drifts.
  double energy_scale() const { return scales_.energy; }

  /// Fills the measured part of the result, whose status and steps must be set. The result of a run that broke off
  /// contains errors against the exact motion only if they were measured at its last state.
  void report(RunResult& result);

 private:
  friend class LaneMeter;   // takes the samples after the start, for a meter in each lane
  friend class LaneErrors;  // measures the errors after the start, for a meter in each lane

  bool measures_invariants() const { return !invariants_.empty() && !invariants_told_; }
  void measure_further(const State<double>& state);
  std::size_t take(std::span<const Sample> samples);
  void follow(const DriftsOfRun& drifts, std::size_t count);
  void measure_errors(const State<double>& state);
  void keep_attitude_error(double t, double error);
  void plan_next_errors(double t);
  void measure_polhode(double t, const BodySnapshot<double>& body, const std::optional<Vector3<double>>& exact_omega);
  static void forget_errors(RunResult& result);
  void judge_by_reference(RunResult& result) const;
  void classify(RunResult& result) const;

  struct Watched {
    const InvariantKind* kind;
    double start = 0, worst = 0;
  };

  const System<double>& system_;
  double t_end_;
  bool exact_at_samples_;
  ConservedMomenta conserved_;
  std::vector<Watched> invariants_;
  bool invariants_told_ = false;
  bool keeps_curves_ = true;
  ExactMotion exact_;
  std::shared_ptr<const ReferenceMotion> reference_;
  std::optional<ReferenceMotion::Follower> follower_;
  bool has_exact_;  ///< an exact solution, at least in part, or a reference is known

  MotionScales scales_;
  Precision precision_;
  DriftOrigin<double> origin_;
  double lost_in_contact_ = 0;  ///< energy lost in contact so far, J
  double next_exact_ = 0;
  std::int64_t exact_count_ = 0;
  ExactMotion::Error worst_error_;
  double errors_until_ = 0;  ///< time of the last measurement of errors, s
  std::vector<AttitudeError> attitude_errors_;
  std::optional<PolhodeError> polhode_;
  PolhodeError::At worst_polhode_;
  std::int64_t samples_ = 0;
  DriftSums<double> sums_;
  ThinnedSeries series_;
  BlockMeans blocks_;
  std::vector<double> impacts_;  ///< times of impacts, thinned, s
};

}  // namespace polhode::study::metrics
