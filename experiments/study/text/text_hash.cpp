// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/text_hash.hpp"

#include <fmt/format.h>
#include <xxhash.h>

namespace polhode::study::inline text {

std::uint64_t text_number(std::string_view text) { return XXH3_64bits(text.data(), text.size()); }

std::string text_hash(std::string_view text) { return fmt::format("{:016x}", text_number(text)); }

}  // namespace polhode::study::text
