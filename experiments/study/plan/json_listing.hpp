// SPDX-License-Identifier: BSD-3-Clause
// Output of --list json: all catalogues as one JSON document, for programs.
#pragma once

#include <span>
#include <string>

#include "experiments/study/record/metric_table.hpp"

namespace polhode::study::inline plan {

/// The JSON text of all catalogues: integrators with equations, sources and settings; scenarios and the keys of
/// scenario files; forces and shapes with their keys; invariants; metrics; options of a run; contact algorithms.
std::string json_listing(std::span<const Metric> metrics);

}  // namespace polhode::study::plan
