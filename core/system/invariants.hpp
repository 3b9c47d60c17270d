// SPDX-License-Identifier: BSD-3-Clause
// Catalogue of additional invariants that a scenario may declare by name: momenta about the axes of a top,
// Kovalevskaya's integral, Casimirs. Each is a scalar function of the state with a unit and a scale for relative drift.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/lanes.hpp"
#include "core/system/system.hpp"

namespace polhode::inline core::inline system {

/// The value of an invariant in the lanes of an ensemble. momentum: the body's angular momentum about its reference
/// point, world axes, kg m²/s.
using LaneInvariant = std::function<Lanes(const BodyMotion<Lanes>& first_body, const Vector3<Lanes>& momentum)>;

/// An invariant of the first body.
struct InvariantKind {
  std::string name;     ///< name, as "p_phi"; the column <name>_drift_max_rel is named after it
  std::string unit;     ///< unit, as "kg m^2/s"
  std::string summary;  ///< formula and meaning
  /// Empty if the invariant applies to the problem; otherwise the reason, for example that the body is not pinned.
  std::string (*refusal)(const Problem&);
  /// Value of the invariant, in `unit`.
  double (*value)(const Problem&, const BodySnapshot<double>& first_body);
  /// The invariant in an ensemble of lane_count problems: in each lane the digits of `value`.
  LaneInvariant (*in_lanes)(std::span<const Problem> problems);
  /// Magnitude of the terms of the value in this state, in `unit`. A relative drift is divided by its maximum along the
  /// exact motion.
  double (*scale)(const Problem&, const BodySnapshot<double>& first_body);
};

const std::vector<InvariantKind>& invariant_catalogue();
/// The entry with this name, or null.
const InvariantKind* find_invariant(std::string_view name);

}  // namespace polhode::core::system
