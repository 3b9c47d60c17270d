// SPDX-License-Identifier: BSD-3-Clause
// The user's text in messages: on one line, and of limited length.
#pragma once

#include <string>
#include <string_view>

namespace polhode::study::inline text {

/// One line: control characters and invalid UTF-8 are escaped (\x0a). The middle of a word longer than 300 bytes, and
/// of a message longer than 3000 bytes, is left out.
std::string legible(std::string_view message);

/// The beginning of a quoted text, at most 40 bytes, escaped as in legible(); "..." stands for the rest.
std::string shortened(std::string_view text);

}  // namespace polhode::study::text
