// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace polhode {

/// How often this program has asked for memory by `new` so far, in all threads.
std::size_t allocations();

}  // namespace polhode
