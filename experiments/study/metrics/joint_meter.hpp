// SPDX-License-Identifier: BSD-3-Clause
// Measures the joints of a run: by how much they open, what it costs in energy to keep them closed, and how far their
// reactions and the velocities of the bodies are from the exact ones.
#pragma once

#include <memory>
#include <optional>

#include "core/exact/exact_motion.hpp"
#include "core/exact/reference_motion.hpp"
#include "core/run/observer.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline metrics {

/// Joints are measured at 1000 instants spread evenly over the run (at the first sample at or after each) and at its
/// end; rank and condition at every tenth of these, since each costs a rank-revealing factorization, and of at most 200
/// equations. Errors are measured at every twentieth, since a reference costs more than a step. Within steps the joints
/// are measured in the first step that ends at or after each of the 1000 instants.
class JointMeter final : public Observer {
 public:
  /// The system must outlive the meter. `reference` may be null; an exact motion then takes its place, if it is known.
  JointMeter(const System<double>& system, double t_end, std::shared_ptr<const ReferenceMotion> reference);

  std::size_t on_samples(std::span<const Sample> samples) override;
  void on_state(const State<double>& state, const Sample& sample) override;
  void on_multipliers(std::span<const double> multipliers) override;
  double next_state() const override { return time_of(instant_); }
  void on_state_within_step(const State<double>& state) override;
  double next_within_step() const override { return time_of(instant_within_); }

  /// Fills the measures of the joints of the result.
  void report(RunResult& result) const { result.joints = found_; }

 private:
  /// The openings of the joints, and their rates.
  struct Opening {
    std::optional<double>&gap, &angle, &velocity, &rate;
  };
  void measure_gaps(std::span<const BodyMotion<double>> motions, const Opening& to) const;
  std::int64_t reached(double t) const;
  double time_of(std::int64_t instant) const;
  void measure_rank(std::span<const BodyMotion<double>> motions);
  void measure_errors(const State<double>& state);
  template <class S>
  void compare(const State<double>& state, const System<S>& system, const VectorX<S>& exact);

  const System<double>& system_;
  double t_end_;
  std::optional<ReferenceMotion::Follower> follower_;
  std::optional<ExactMotion> exact_;
  VectorX<double> multipliers_;      ///< multipliers of the next state, if the method solves for them; else empty
  std::int64_t instant_ = 0;         ///< number of the next instant of measurement, 0 … 1000
  std::int64_t instant_within_ = 0;  ///< likewise of the next measurement within a step
  JointMeasures found_;
};

}  // namespace polhode::study::metrics
