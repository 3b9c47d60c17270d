// SPDX-License-Identifier: BSD-3-Clause
// Search for the first impact of a flight, which is the first root of a guard. The flight is halved while the bounds of
// the guards allow negative values in between. TOMS 748 locates the root in the bracket.
#pragma once

#include <array>
#include <optional>

#include "collision/contact/flight_path.hpp"
#include "collision/contact/guards.hpp"

namespace polhode::inline collision::inline contact {

/// The search for the first impact.
class ImpactSearch {
 public:
  ImpactSearch(Guards& guards, const ContactLengths& lengths) : guards_(guards), lengths_(lengths) {}

  /// Time (s) from the start of the flight to the first root of a guard. Absent if there is none; 0 if pairs that touch
  /// at the start do not separate. `start` and `end` are the states at the ends of the flight, `length` its duration
  /// (s).
  std::optional<double> first_impact(FlightPath& path, const State<double>& start, const State<double>& end,
                                     double length);

 private:
  static constexpr int deepest = 20;  ///< halvings; negative guards for less than 1e-6 of the flight may be missed

  double first_below(FlightPath& path, double from, const Guards::Values& at_from, double to,
                     const Guards::Values& at_to, int depth);

  Guards& guards_;
  const ContactLengths& lengths_;
  std::array<Guards::Values, deepest + 1> midpoints_;  ///< guards at the midpoint of each level of halving
  Guards::Values at_start_, at_end_;
  State<double> there_;
};

}  // namespace polhode::collision::contact
