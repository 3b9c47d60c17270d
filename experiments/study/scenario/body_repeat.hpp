// SPDX-License-Identifier: BSD-3-Clause
// Expands one [[body]] with the key `repeat` into copies on a grid, with optional jitter.
#pragma once

#include <vector>

#include "experiments/study/scenario/body_reader.hpp"

namespace polhode::study::inline scenario {

/// The copies of a body with the key `repeat`, first axis fastest, named NAME_0, NAME_1, …; for any other body the body
/// itself. `index` (of the table in the scenario) seeds the jitter, so that the copies are the same in every run.
/// Throws a Fault.
std::vector<ReadBody> repeated(const TomlCursor& table, std::size_t index, ReadBody body);

}  // namespace polhode::study::scenario
