// SPDX-License-Identifier: BSD-3-Clause
// The order that a method declares for a given motion.
#pragma once

#include <optional>

#include "core/run/integrator.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline curves {

/// The free order, if the method declares one, for bodies without forces, and for the attitude of bodies without
/// torques; otherwise the order under forces. Absent: the method is exact.
std::optional<double> declared_order(const Declaration& method, const Scenario& scenario, bool attitude);

/// The order of the reactions of joints: that of the method's own multipliers, if it has some, else of its motion.
std::optional<double> declared_reaction_order(const Declaration& method, const Scenario& scenario);

/// The order for a run's own motion; the order under forces if its scenario is not known.
std::optional<double> declared_order(const Declaration& method, const RunRecord& run, bool attitude);

}  // namespace polhode::study::curves
