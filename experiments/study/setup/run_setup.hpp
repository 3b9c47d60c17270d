// SPDX-License-Identifier: BSD-3-Clause
// Puts a run together from its configuration: schedule, method and contact, for studies and for the viewer's sessions
// alike.
#pragma once

#include <memory>

#include "collision/contact/contact_scene.hpp"
#include "core/run/simulate.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline setup {

Schedule schedule_of(const RunConfig& config);

/// In float, double, long double, or the lanes of an ensemble, where nothing is compensated; the system must outlive
/// it.
template <class S>
std::unique_ptr<Integrator<S>> integrator_of(const RunConfig& config, const System<S>& system);

/// The bodies that can touch, and how it is answered.
struct ContactSetup {
  /// Registers a force with the system, which must outlive it.
  ContactSetup(System<double>& system, const Scenario& scenario, const ContactConfig& config);

  ContactScene scene;
  std::unique_ptr<ContactModel> model;  ///< none where the response is a force
};

}  // namespace polhode::study
