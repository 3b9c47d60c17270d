// SPDX-License-Identifier: BSD-3-Clause
// The bodies of a scenario by name, as forces and joints name them.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/study/text/toml_cursor.hpp"

namespace polhode::study::inline scenario {

/// A body of a Problem.
struct NamedBody {
  std::size_t index;
  bool has_mass;
};
using BodyIndex = std::map<std::string, NamedBody, std::less<>>;

/// The body that a text names. Throws a Fault that lists the bodies there are.
const NamedBody& read_body_name(const TomlCursor& name, const BodyIndex& index);

}  // namespace polhode::study::scenario
