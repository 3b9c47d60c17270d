// SPDX-License-Identifier: BSD-3-Clause
// Hash of a text, for names of contents.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace polhode::study::inline text {

/// XXH3 (64 bits) of the bytes, as 16 hexadecimal digits.
std::string text_hash(std::string_view text);
/// The same as a number.
std::uint64_t text_number(std::string_view text);

}  // namespace polhode::study::text
