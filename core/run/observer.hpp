// SPDX-License-Identifier: BSD-3-Clause
// The port of observers: the data that a run gives while it goes, in double for every scalar type of the run.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "core/run/contact_model.hpp"
#include "core/run/integrator.hpp"

namespace polhode::inline core::inline run {

class Observer {
 public:
  virtual ~Observer() = default;

  /// Receives the initial state and its sample, once, before everything else. By default it counts as any state.
  virtual void on_start(const State<double>& state, const Sample& sample) { on_state(state, sample); }

  /// Receives consecutive samples. The first sample of a run is the start. Sample::projection is the sum over the run.
  /// Returns the number of accepted samples. If it is less than all, the run ends as diverged at the next sample.
  virtual std::size_t on_samples(std::span<const Sample> samples) { return samples.size(); }

  /// Receives the full state at the latest sample, for each sample at or after next_state().
  virtual void on_state(const State<double>&, const Sample&) {}
  /// Time (s) from which the next full state is due; 0: at every sample; +inf: never. A method may take many steps in
  /// one call before it.
  virtual double next_state() const { return std::numeric_limits<double>::infinity(); }

  /// Receives states within the last step, for each step that ends at or after next_within_step() and whose method has
  /// dense output: at a quarter, a half and three quarters of the step, as the method takes it, before a projection
  /// that follows. Not in runs with a contact model.
  virtual void on_state_within_step(const State<double>&) {}
  virtual double next_within_step() const { return std::numeric_limits<double>::infinity(); }

  /// Receives the multipliers of the joints for the next full state, from a method that solves for them itself.
  virtual void on_multipliers(std::span<const double>) {}

  /// Receive the impacts of a step, the ends of its sliding phases, and the energy balance of the contacts up to the
  /// next sample. Called before that sample, only in runs with a contact model.
  virtual void on_impacts(std::span<const Impact>) {}
  virtual void on_slides_end(std::span<const Transition>) {}
  virtual void on_contact_energy(const ContactLosses&) {}
};

/// Observers side by side: each receives what it would receive alone. They must outlive this one.
class Observers final : public Observer {
 public:
  void add(Observer& observer) { all_.push_back(&observer); }

  void on_start(const State<double>& state, const Sample& sample) override {
    for (Observer* one : all_) one->on_start(state, sample);
  }
  /// The least number that one of them accepts.
  std::size_t on_samples(std::span<const Sample> samples) override {
    std::size_t accepted = samples.size();
    for (Observer* one : all_) accepted = std::min(accepted, one->on_samples(samples));
    return accepted;
  }
  void on_state(const State<double>& state, const Sample& sample) override {
    for (Observer* one : all_) {
      if (sample.t >= one->next_state()) one->on_state(state, sample);
    }
  }
  /// The earliest time at which one of them is due.
  double next_state() const override {
    double next = std::numeric_limits<double>::infinity();
    for (const Observer* one : all_) next = std::min(next, one->next_state());
    return next;
  }
  void on_state_within_step(const State<double>& state) override {
    for (Observer* one : all_) one->on_state_within_step(state);
  }
  double next_within_step() const override {
    double next = std::numeric_limits<double>::infinity();
    for (const Observer* one : all_) next = std::min(next, one->next_within_step());
    return next;
  }
  void on_multipliers(std::span<const double> multipliers) override {
    for (Observer* one : all_) one->on_multipliers(multipliers);
  }
  void on_impacts(std::span<const Impact> impacts) override {
    for (Observer* one : all_) one->on_impacts(impacts);
  }
  void on_slides_end(std::span<const Transition> transitions) override {
    for (Observer* one : all_) one->on_slides_end(transitions);
  }
  void on_contact_energy(const ContactLosses& losses) override {
    for (Observer* one : all_) one->on_contact_energy(losses);
  }

 private:
  std::vector<Observer*> all_;
};

}  // namespace polhode::core::run
