// SPDX-License-Identifier: BSD-3-Clause
// The largest study.
#pragma once

#include <cstddef>

namespace polhode::study::inline plan {

constexpr std::size_t most_runs = 10'000'000;

}  // namespace polhode::study::plan
