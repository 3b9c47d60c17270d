// SPDX-License-Identifier: BSD-3-Clause
// Watches what contact does in a run: where energy goes, how deep bodies are in each other, whether they stay where
// they are.
#pragma once

#include <vector>

#include "collision/contact/contact_scene.hpp"
#include "core/run/simulate.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline metrics {

/// An observer that hands everything on to the next one. Places are looked at at 1000 instants spread evenly over the
/// run (the first sample at or after each) and at its end, depths at every tenth of them, since they cost as much as
/// finding contacts.
class ContactMeter final : public Observer {
 public:
  ContactMeter(const System<double>& system, const Scenario& scenario, const ContactConfig& config, double t_end);

  void on_start(const State<double>& state, const Sample& sample) override;
  std::size_t on_samples(std::span<const Sample> samples) override;
  void on_state(const State<double>& state, const Sample& sample) override;
  void on_impacts(std::span<const Impact> impacts) override;
  void on_contact_energy(const ContactLosses& losses) override;
  double next_state() const override;

  /// Fills the part of the result that is about contact.
  void report(RunResult& result) const;

 private:
  void measure_depth(const State<double>& state);
  void measure_places(const State<double>& state);

  const System<double>& system_;
  ContactScene scene_;  ///< separate from that of the run, whose data cached by pair stay unchanged
  double t_end_;
  std::int64_t instant_ = 0;  ///< the next one
  ContactMeasures found_;
  double energy_start_ = 0, energy_least_ = 0;  ///< J
  std::vector<Pose> poses_, started_, settled_;
};

}  // namespace polhode::study
