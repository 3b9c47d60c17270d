// SPDX-License-Identifier: BSD-3-Clause
// The order that a method declares for the motion at hand.
#pragma once

#include <optional>

#include "core/run/integrator.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline curves {

/// Its free order, where it declares one, for bodies without forces, and for their attitude without torques; otherwise
/// the order under forces. Absent: it is exact.
std::optional<double> declared_order(const Declaration& method, const Scenario& scenario, bool attitude);

/// For a run's own motion; the order under forces where its scenario is not known.
std::optional<double> declared_order(const Declaration& method, const RunRecord& run, bool attitude);

}  // namespace polhode::study
