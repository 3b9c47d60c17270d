// SPDX-License-Identifier: BSD-3-Clause
// First line of judge's report about a trajectory.
#pragma once

#include <optional>
#include <string>

#include "experiments/judge/diagnosis.hpp"

namespace polhode::study::judge {

/// Results of judge for one trajectory.
struct Judged {
  TrajectoryScore score;
  Diagnosis diagnosis;
  std::optional<TrajectoryScore> meant;  ///< the score of diagnosis.meant
};

/// Motion along the polhode: "on_time", "early", "late", "standing", "backwards", or "off" if the motion has left its
/// polhode; empty if there is none.
std::string polhode_pace(const TrajectoryScore& score);

/// The line, without a line break: "engine: ω × Iω has the wrong sign: …. Energy holds to 1e-11, …".
std::string first_line(const Judged& judged);

}  // namespace polhode::study::judge
