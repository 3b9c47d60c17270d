// SPDX-License-Identifier: BSD-3-Clause
// Reads one [[body]] of a scenario: its matter (mass, inertia, mass centre) and how it starts.
#pragma once

#include "collision/contact/collider.hpp"
#include "core/problem/body.hpp"
#include "experiments/study/text/toml_cursor.hpp"

namespace polhode::study::inline scenario {

struct ReadBody {
  Body body;
  BodyStart start;
  bool has_mass = false;  ///< false of a static body that is given none
  ShapePointer shape;     ///< null where the scenario names none, or one that has moments alone
  Collider collider;      ///< without a shape where the scenario has no contact
  std::string canonical_collider{};
};

/// What a body says of a key, or the default.
TomlCursor body_key(const TomlCursor& body, std::string_view name);

/// `index` gives the name of a body that has none: body0, body1, … With `contact` a shape is one that touches. Throws a
/// Fault.
ReadBody read_body(const TomlCursor& table, std::size_t index, bool contact);

}  // namespace polhode::study
