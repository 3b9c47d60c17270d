// SPDX-License-Identifier: BSD-3-Clause
// Test whether a run follows the motion. A bounded energy is not sufficient: a top may be turned by π and still have
// the right energy.
#pragma once

#include <string_view>

#include "experiments/study/record/run_record.hpp"

namespace polhode::study::stability {

/// Bounds of the errors of a motion that is followed: rough ones, within which the run still resembles the motion.
namespace followed {
inline constexpr double attitude = 1;     ///< error against the exact motion or a reference, rad
inline constexpr double position = 0.25;  ///< error over the largest displacement of the exact path: half an amplitude
/// Relative drift of momenta and of the scenario's further invariants; if the motion is not known, also of the energy.
inline constexpr double momentum = 0.1;
inline constexpr double defect = 0.1;  ///< orientation defect
}  // namespace followed

/// Quantity that is lost: the first of these that exceeds its bound.
enum class Lost {
  nothing,
  end,  ///< the run diverged or failed
  attitude,
  position,
  momentum,
  invariant,
  orientation,  ///< the orientation defect
  energy,       ///< tested only if the motion is not known
};
constexpr std::string_view name(Lost lost) {
  switch (lost) {
    case Lost::end: return "run ended";
    case Lost::attitude: return "attitude";
    case Lost::position: return "position";
    case Lost::momentum: return "momentum";
    case Lost::invariant: return "invariant";
    case Lost::orientation: return "orientation defect";
    case Lost::energy: return "energy";
    default: return "";
  }
}

/// The quantity that the run has lost. displacement: that of the exact path (exact_displacement()), m; 0: positions are
/// not tested.
Lost what_is_lost(const RunRecord& run, double displacement);

/// True if the run was measured against a known motion: its attitudes and, unless every body is pinned, its positions.
bool has_known_motion(const RunRecord& run);

/// Largest displacement of the mass centres from their initial positions between 0 and t_end (s), by their exact paths,
/// m. 0 if a path is not known, or if no mass centre moves.
double exact_displacement(const Problem& problem, const Formulation& formulation, double t_end);

}  // namespace polhode::study::stability
