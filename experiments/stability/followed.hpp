// SPDX-License-Identifier: BSD-3-Clause
// Is the motion of a run followed? An energy that stays bounded does not say so: a top may be turned by π and still
// have the right energy.
#pragma once

#include <string_view>

#include "experiments/study/record/run_record.hpp"

namespace polhode::study::stability {

/// The bounds of a motion that is followed: rough ones, within which the run still resembles the motion.
namespace followed {
inline constexpr double attitude = 1;     ///< rad, error against the exact motion or a reference
inline constexpr double position = 0.25;  ///< error over the largest displacement of the exact path: half an amplitude
inline constexpr double momentum = 0.1;  ///< relative drift of momenta and of the scenario's further invariants; of the
                                         ///< energy too, where the motion is not known
inline constexpr double defect = 0.1;  ///< of the orientation
}  // namespace followed

/// What was lost: the first of these that is beyond its bound.
enum class Lost {
  nothing,
  end,  ///< the run diverged or failed
  attitude,
  position,
  momentum,
  invariant,
  orientation,  ///< its defect
  energy,       ///< judged only where the motion is not known
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

/// `displacement`: m, of the exact path (exact_displacement()); 0: positions are not judged.
Lost what_is_lost(const RunRecord& run, double displacement);

/// True if the run was measured against a known motion: its attitudes and, unless every body is pinned, its positions.
bool has_known_motion(const RunRecord& run);

/// m, how far the mass centres get from where they start, at most, from 0 to t_end (s), by their exact paths. 0 where
/// a path is not known, or none leads anywhere.
double exact_displacement(const Problem& problem, const Formulation& formulation, double t_end);

}  // namespace polhode::study
