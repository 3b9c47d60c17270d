// SPDX-License-Identifier: BSD-3-Clause
// The numbers of a result by their places in it: the store keeps them in this order, and all of them are finite.
#pragma once

#include "experiments/study/record/run_record.hpp"

namespace polhode::study {

/// The columns of the store's table `drifts`.
inline constexpr std::optional<double> RunResult::*drift_members[] = {
    &RunResult::energy_drift_rate_ci,     &RunResult::drift_exponent,          &RunResult::drift_exponent_low,
    &RunResult::drift_exponent_high,      &RunResult::polhode_phase_error_max, &RunResult::polhode_phase_error_max_rad,
    &RunResult::polhode_off_error_max_rel};

/// The columns of the table `energies`.
inline constexpr std::optional<double> RunResult::*energy_members[] = {
    &RunResult::energy_scale, &RunResult::energy_drift_max, &RunResult::energy_round_off,
    &RunResult::drift_decided_after};

/// The columns of the table `contacts`.
inline constexpr std::optional<double> ContactMeasures::*contact_members[] = {
    &ContactMeasures::first_impact,       &ContactMeasures::impact_loss,     &ContactMeasures::friction_loss,
    &ContactMeasures::penetration_energy, &ContactMeasures::energy_rise_max, &ContactMeasures::energy_change_max,
    &ContactMeasures::penetration_max,    &ContactMeasures::penetration_end, &ContactMeasures::displacement_max,
    &ContactMeasures::left_place};

/// Those among the columns of the table `runs`.
inline constexpr std::optional<double> RunResult::*run_members[] = {&RunResult::energy_initial,
                                                                    &RunResult::energy_drift_max_rel,
                                                                    &RunResult::energy_drift_final_rel,
                                                                    &RunResult::energy_drift_rate,
                                                                    &RunResult::linear_momentum_drift_max_rel,
                                                                    &RunResult::angular_momentum_drift_max_rel,
                                                                    &RunResult::orientation_defect_max,
                                                                    &RunResult::position_error_max,
                                                                    &RunResult::attitude_error_max,
                                                                    &RunResult::angular_velocity_error_max_rel};

/// Takes every number out of the result that is not finite, and the sign off every zero. The uncertainty of a reference
/// stays: it is infinite where the reference could not follow the motion.
void keep_finite(RunResult& result);

}  // namespace polhode::study
