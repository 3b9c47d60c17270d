// SPDX-License-Identifier: BSD-3-Clause
// Work in parts: the parts are made on several threads, and what is made of them is used in their order.
#pragma once

#include <cstddef>
#include <functional>

namespace polhode::study::inline text {

/// Number of threads of a program that was given --jobs; 0: as many as the machine has cores.
std::size_t number_of_threads(int jobs);

/// Uses what was made of a part.
using UsePart = std::function<void()>;

/// Calls make(part) for each part from 0 to parts - 1 on `threads` threads, and what it returns on one thread at a
/// time, in ascending order of the parts. At most `ahead` parts are made and not yet used; 0: two a thread. If make or
/// a use throws, the exception of the first such part is rethrown after all parts before it were used.
void in_order(std::size_t parts, std::size_t threads, const std::function<UsePart(std::size_t part)>& make,
              std::size_t ahead = 0);

}  // namespace polhode::study::text
