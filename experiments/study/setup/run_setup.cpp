// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/setup/run_setup.hpp"

#include "collision/contact/impact_timing.hpp"
#include "experiments/study/setup/end_at_contact.hpp"
#include "integrators/catalogue.hpp"
#include "integrators/compensated.hpp"

namespace polhode::study::inline setup {

Schedule schedule_of(const RunConfig& config) {
  Schedule schedule;
  schedule.t_end = config.t_end;
  schedule.adaptive = !config.dt.has_value();
  schedule.dt = config.dt.value_or(0);
  if (config.max_steps) schedule.most_steps = *config.max_steps;
  schedule.samples = config.samples;
  schedule.normalize = config.normalize;
  return schedule;
}

Formulation formulation_of(const RunConfig& config) {
  Formulation formulation = config.formulation;
  if (!config.joints) return formulation;
  JointTreatment& joints = formulation.joints;
  joints.stabilization = config.joints->stabilization;
  joints.metric = config.joints->metric;
  constexpr double usual = 10, usual_penalty = 1e7;  // usual coefficients, 1/s; usual penalty, over the mean mass
  if (joints.is_soft()) joints.penalty = config.joints->penalty.value_or(usual_penalty);
  if (!joints.has_baumgarte_terms()) return formulation;
  if (config.joints->alpha_per_step && config.dt) {
    joints.alpha = joints.beta = *config.joints->alpha_per_step / *config.dt;
  } else {
    joints.alpha = config.joints->alpha.value_or(usual);
    joints.beta = config.joints->beta.value_or(usual);
  }
  return formulation;
}

template <class S>
std::unique_ptr<Integrator<S>> integrator_of(const RunConfig& config, const System<S>& system) {
  const IntegratorSettings settings{.dt = config.dt.value_or(0),
                                    .tolerance = config.tolerance.value_or(0),
                                    .t_end = config.t_end,
                                    .project = config.normalize,
                                    .chosen = config.settings};
  const IntegratorEntry& entry = *find_integrator(config.integrator);
  if constexpr (!is_lanes<S>) {
    if (is_compensated(config)) return make_compensated<S>(entry, system, settings);
  }
  return entry.maker<S>()(system, settings);
}

template std::unique_ptr<Integrator<float>> integrator_of(const RunConfig&, const System<float>&);
template std::unique_ptr<Integrator<double>> integrator_of(const RunConfig&, const System<double>&);
template std::unique_ptr<Integrator<long double>> integrator_of(const RunConfig&, const System<long double>&);
template std::unique_ptr<Integrator<Lanes>> integrator_of(const RunConfig&, const System<Lanes>&);

ContactSetup::ContactSetup(System<double>& system, const Scenario& scenario, const ContactConfig& config)
    : scene(scenario.problem, scenario.colliders, config.broad_phase, config.narrow_phase) {
  const ResponseEntry& response = *find_response(config.response);
  if (!response.make) {
    system.add_force(response.make_force(system, scene, scenario.compliance));
    return;
  }
  const ImpactTimingEntry& timing = *find_impact_timing(config.impact_timing);
  model = timing.make(system, scene, response.make());
  if (scenario.end_at_contact) model = std::make_unique<EndAtContact>(std::move(model), !timing.fixed_steps_only);
}

}  // namespace polhode::study::setup
