// SPDX-License-Identifier: BSD-3-Clause
// One [[body]] that stands for many: copies on a grid, each a little off it where the scenario says so.
#pragma once

#include <vector>

#include "experiments/study/scenario/body_reader.hpp"

namespace polhode::study::inline scenario {

/// The copies of a body with the key `repeat`, the first axis fastest, called NAME_0, NAME_1, …; of any other body
/// itself. `index` (of the table in the scenario) seeds the jitter: the same scenario has the same copies. Throws a
/// Fault.
std::vector<ReadBody> repeated(const TomlCursor& table, std::size_t index, ReadBody body);

}  // namespace polhode::study
