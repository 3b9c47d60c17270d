// SPDX-License-Identifier: BSD-3-Clause
// Reads the keys of a force or a shape as its schema (core/problem/force_kind.hpp) has them.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/problem/force_kind.hpp"
#include "experiments/study/text/toml_cursor.hpp"

namespace polhode::study::inline scenario {

/// Every key of `parameters`, with defaults filled in. `also` are the keys of the table that are not parameters
/// ("kind"); `introduction` is "A spring has"; `bodies` is how many bodies a force acts on. Throws a Fault on a key
/// that is unknown, missing, of a wrong type or out of range, or that makes no sense with so many bodies.
std::map<std::string, ParameterValue> read_parameters(const TomlCursor& table, const std::vector<Parameter>& parameters,
                                                      std::vector<std::string_view> also, std::string_view introduction,
                                                      std::size_t bodies = 0);

}  // namespace polhode::study
