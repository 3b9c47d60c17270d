// SPDX-License-Identifier: BSD-3-Clause
// Output of --list: the catalogues, one line of physics or mathematics per entry.
#pragma once

#include <span>
#include <string>

#include "experiments/study/record/metric_table.hpp"

namespace polhode::study::inline plan {

/// The text of a catalogue; `what` is an argument of --list, "" for all catalogues, "json" for all of them in JSON.
/// Throws InputError for an unknown catalogue.
std::string listing(const std::string& what, std::span<const Metric> metrics = metric_table());

}  // namespace polhode::study::plan
