// SPDX-License-Identifier: BSD-3-Clause
// Measures contact in a run: the energy balance, penetration depths, and displacements of bodies.
#pragma once

#include <vector>

#include "collision/contact/contact_scene.hpp"
#include "core/run/simulate.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline metrics {

/// Positions are measured at 1000 instants spread evenly over
/// the run (at the first sample at or after each) and at its end. Depths are measured at every tenth of these instants,
/// since each costs as much as contact detection.
class ContactMeter final : public Observer {
 public:
  ContactMeter(const System<double>& system, const Scenario& scenario, const ContactConfig& config, double t_end);

  void on_start(const State<double>& state, const Sample& sample) override;
  std::size_t on_samples(std::span<const Sample> samples) override;
  void on_state(const State<double>& state, const Sample& sample) override;
  void on_impacts(std::span<const Impact> impacts) override;
  void on_contact_energy(const ContactLosses& losses) override;
  double next_state() const override;

  /// Fills the contact measures of the result.
  void report(RunResult& result) const;

 private:
  void measure_depth(const State<double>& state);
  void measure_places(const State<double>& state);

  const System<double>& system_;
  ContactScene scene_;  ///< separate from that of the run, whose data cached by pair stay unchanged
  double t_end_;
  std::int64_t instant_ = 0;  ///< number of the next instant of measurement, 0 … 1000
  ContactMeasures found_;
  double energy_start_ = 0, energy_least_ = 0;  ///< J
  std::vector<Pose> poses_, started_, settled_;
};

}  // namespace polhode::study::metrics
