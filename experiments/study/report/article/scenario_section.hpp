// SPDX-License-Identifier: BSD-3-Clause
// The data of a scenario as tables: bodies with mass, inertia and start, forces with their parameters.
#pragma once

#include "experiments/study/plot/table.hpp"
#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline report::inline article {

/// A row for each of the first bodies.
Table table_of_bodies(const Scenario& scenario);
/// A row for each parameter of each force; no row where no force acts.
Table table_of_forces(const Scenario& scenario);
Table table_of_joints(const Scenario& scenario);

}  // namespace polhode::study::report::article
