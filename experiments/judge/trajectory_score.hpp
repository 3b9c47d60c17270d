// SPDX-License-Identifier: BSD-3-Clause
// Scores a trajectory of any origin: measures it like a run of a study, with the scenario's inertia and forces, and
// compares it with the exact motion or a reference.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/metrics/references.hpp"
#include "experiments/study/record/run_record.hpp"
#include "experiments/study/trajectory/trajectory_reader.hpp"

namespace polhode::study::judge {

/// Errors at one instant; absent if they are not known.
struct ErrorPoint {
  double t = 0;                                                ///< s
  std::optional<double> position, attitude, angular_velocity;  ///< errors in m, in rad, relative
  std::optional<double> phase, off;                            ///< errors along the polhode (s) and off it (relative)
};

struct TrajectoryScore {
  RunRecord record;  ///< method: label of the file; dt: largest spacing of the rows; steps: their number
  std::size_t instants = 0;
  double t_first = 0;              ///< time of the first instant, s
  std::vector<ErrorPoint> errors;  ///< errors at up to 257 instants, evenly spread, the last one included
  /// Largest difference between the energy column of the file and the computed energy, over the energy scale.
  std::optional<double> energy_column_difference_max_rel;
  std::vector<std::string> notes;  ///< derived quantities, and missing ones with the reason
};

/// Scores a trajectory. The formulation of `config` determines the rotation of a quaternion off the unit sphere; its
/// chart is replaced by that of the trajectory.
TrajectoryScore score(const Trajectory& trajectory, const Scenario& scenario, RunConfig config,
                      References* references = nullptr, const std::atomic<bool>* stop = nullptr);

/// Run id from a text with everything that determines the result: 16 hexadecimal digits.
std::string identity_of(std::string_view text);

}  // namespace polhode::study::judge
