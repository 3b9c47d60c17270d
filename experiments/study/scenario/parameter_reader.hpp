// SPDX-License-Identifier: BSD-3-Clause
// Reads the keys of a force or a shape according to its schema (core/problem/force_kind.hpp).
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/problem/force_kind.hpp"
#include "experiments/study/text/toml_cursor.hpp"

namespace polhode::study::inline scenario {

/// The values of all keys of `parameters`, with defaults filled in. `also`: keys of the table that are not parameters
/// ("kind"); `introduction`: "A spring has"; `bodies`: number of bodies that a force acts on. Throws a Fault for a key
/// that is unknown, missing, of a wrong type or out of range, or that requires another number of bodies.
std::map<std::string, ParameterValue> read_parameters(const TomlCursor& table, const std::vector<Parameter>& parameters,
                                                      std::vector<std::string_view> also, std::string_view introduction,
                                                      std::size_t bodies = 0);

}  // namespace polhode::study::scenario
