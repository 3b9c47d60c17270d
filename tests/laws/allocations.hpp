// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace polhode {

/// The number of requests for memory by `new` in this program so far, in all threads.
std::size_t allocations();

}  // namespace polhode
