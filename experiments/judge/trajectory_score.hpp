// SPDX-License-Identifier: BSD-3-Clause
// Scores a trajectory that came from anywhere: measured by the scenario's own inertia and forces like a run of ours,
// and set against the exact motion, or a reference.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/metrics/references.hpp"
#include "experiments/study/record/run_record.hpp"
#include "experiments/study/trajectory/trajectory_reader.hpp"

namespace polhode::study::judge {

/// The errors at one instant; absent where they are not known.
struct ErrorPoint {
  double t = 0;                                                ///< s
  std::optional<double> position, attitude, angular_velocity;  ///< m, rad, relative
  std::optional<double> phase, off;                            ///< along the polhode (s) and off it (relative)
};

struct TrajectoryScore {
  RunRecord record;  ///< its method is the file's label, its dt the largest spacing of the rows, its steps their number
  std::size_t instants = 0;
  double t_first = 0;              ///< s
  std::vector<ErrorPoint> errors;  ///< at most 257, evenly over the instants, the last one among them
  /// The largest difference between the file's own energy and ours, over the scale of energy drifts.
  std::optional<double> energy_column_difference_max_rel;
  std::vector<std::string> notes;  ///< what was derived, what is left empty and why
};

/// The formulation of `config` says how a quaternion off the unit sphere is read; its chart is chosen by the
/// trajectory.
TrajectoryScore score(const Trajectory& trajectory, const Scenario& scenario, RunConfig config,
                      References* references = nullptr, const std::atomic<bool>* stop = nullptr);

/// A name for a run from all that decides its result: 16 hexadecimal digits.
std::string identity_of(std::string_view text);

}  // namespace polhode::study
