// SPDX-License-Identifier: BSD-3-Clause
// Further invariants that a scenario may declare by name: momenta about the axes of a top, Kovalevskaya's integral,
// Casimirs. Each is a number of the state with a unit and a scale against which its drift is taken.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/system/system.hpp"

namespace polhode {

struct InvariantKind {
  std::string name;     ///< "p_phi": also the column <name>_drift_max_rel
  std::string unit;     ///< "kg m^2/s"
  std::string summary;  ///< formula and meaning
  /// Empty if it makes sense for the problem; otherwise the reason (it wants one pinned body, say).
  std::string (*refusal)(const Problem&);
  double (*value)(const Problem&, const BodySnapshot<double>& first_body);
  /// The size of the terms of the value in this state: what a drift is relative to is its largest along the true
  /// motion.
  double (*scale)(const Problem&, const BodySnapshot<double>& first_body);
};

const std::vector<InvariantKind>& invariant_catalogue();
const InvariantKind* find_invariant(std::string_view name);

}  // namespace polhode
