// SPDX-License-Identifier: BSD-3-Clause
// The id of a run as a number, for lists of many runs.
#pragma once

#include <cstdint>
#include <string>

namespace polhode::study::inline record {

/// The id as an integer, and back: 16 hexadecimal digits. Throws std::logic_error for a text that is no id.
std::uint64_t number_of_id(const std::string& id);
std::string id_of_number(std::uint64_t number);

}  // namespace polhode::study::record
