// SPDX-License-Identifier: BSD-3-Clause
// Measures the joints of a run: by how much they open, and what it costs in energy to keep them closed.
#pragma once

#include "core/run/observer.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline metrics {

/// Joints are measured at 1000 instants spread evenly over the run (at the first sample at or after each) and at its
/// end; rank and condition at every tenth of these, since each costs a rank-revealing factorization,
/// and of at most 200 equations.
class JointMeter final : public Observer {
 public:
  /// The system must outlive the meter.
  JointMeter(const System<double>& system, double t_end) : system_(system), t_end_(t_end) {}

  std::size_t on_samples(std::span<const Sample> samples) override;
  void on_state(const State<double>& state, const Sample& sample) override;
  double next_state() const override;

  /// Fills the measures of the joints of the result.
  void report(RunResult& result) const { result.joints = found_; }

 private:
  const System<double>& system_;
  double t_end_;
  std::int64_t instant_ = 0;  ///< number of the next instant of measurement, 0 … 1000
  JointMeasures found_;
};

}  // namespace polhode::study::metrics
