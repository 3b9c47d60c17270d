// SPDX-License-Identifier: BSD-3-Clause
// Text of the user in messages: on one line, and not longer than somebody reads.
#pragma once

#include <string>
#include <string_view>

namespace polhode::study::inline text {

/// One line: control characters, and bytes that are no UTF-8, are spelled out (\x0a). Of a word longer than 300 bytes,
/// and of a message longer than 3000, the middle is left out.
std::string legible(std::string_view message);

/// The beginning of what is quoted, 40 bytes at most, spelled out as legible() does it; "..." stands for the rest.
std::string shortened(std::string_view text);

}  // namespace polhode::study
