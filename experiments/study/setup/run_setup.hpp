// SPDX-License-Identifier: BSD-3-Clause
// Builds the parts of a run from its configuration (schedule, method, contact), for studies and for the viewer's
// sessions.
#pragma once

#include <memory>

#include "collision/contact/contact_scene.hpp"
#include "core/run/simulate.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline setup {

Schedule schedule_of(const RunConfig& config);

/// The formulation of a run, with the treatment of its joints.
Formulation formulation_of(const RunConfig& config);

/// The method in float, double, long double, or the lanes of an ensemble (without compensated summation). The system
/// must outlive it.
template <class S>
std::unique_ptr<Integrator<S>> integrator_of(const RunConfig& config, const System<S>& system);

/// Contact scene and contact model of a run.
struct ContactSetup {
  /// Registers a force with the system. The system must outlive this object.
  ContactSetup(System<double>& system, const Scenario& scenario, const ContactConfig& config);

  ContactScene scene;
  std::unique_ptr<ContactModel> model;  ///< null if the response is a force
};

}  // namespace polhode::study::setup
