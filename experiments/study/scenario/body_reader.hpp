// SPDX-License-Identifier: BSD-3-Clause
// Reads one [[body]] of a scenario: mass, inertia, mass centre, shape and initial state.
#pragma once

#include "collision/contact/collider.hpp"
#include "core/problem/body.hpp"
#include "experiments/study/text/toml_cursor.hpp"

namespace polhode::study::inline scenario {

struct ReadBody {
  Body body;
  BodyStart start;
  bool has_mass = false;  ///< false for a static body without a mass
  ShapePointer shape;     ///< null if the scenario names no shape, or one that cannot collide
  Collider collider;      ///< collider, without a shape if the scenario has no contact
  std::string canonical_collider{};
};

/// The value of a body's key, or its default.
TomlCursor body_key(const TomlCursor& body, std::string_view name);

/// The initial state in the table of a body. Throws a Fault.
BodyStart read_start(const TomlCursor& table, const Body& body);
/// True for the keys that read_start() reads and no other step.
bool is_of_start(std::string_view key);

/// Reads a body. `index` names a body without a name: body0, body1, … With `contact` the shape must be one that
/// collides. Throws a Fault.
ReadBody read_body(const TomlCursor& table, std::size_t index, bool contact);

}  // namespace polhode::study::scenario
