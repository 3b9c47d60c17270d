// SPDX-License-Identifier: BSD-3-Clause
// What judge says of a trajectory before anything else.
#pragma once

#include <optional>
#include <string>

#include "experiments/judge/diagnosis.hpp"

namespace polhode::study::judge {

/// A trajectory with all that is said of it.
struct Judged {
  TrajectoryScore score;
  Diagnosis diagnosis;
  std::optional<TrajectoryScore> meant;  ///< the score of diagnosis.meant
};

/// How the motion goes along its polhode: "on_time", "early", "late", "standing", "backwards", or "off" where it has
/// left it; empty where there is none.
std::string polhode_pace(const TrajectoryScore& score);

/// "engine: ω × Iω has the wrong sign: …. Energy holds to 1e-11, …": one line without its end.
std::string first_line(const Judged& judged);

}  // namespace polhode::study
