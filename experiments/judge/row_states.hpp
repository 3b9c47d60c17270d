// SPDX-License-Identifier: BSD-3-Clause
// Rows of a trajectory as states of the scenario's bodies, under any reading of the columns, and the selection of rows
// that are compared with a motion: spans of half a radian, and rows of the first two radians.
//
// States are flat, in the formulation (quaternion, velocity_world), as in faulty_motion.hpp.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/exact/exact_motion.hpp"
#include "experiments/judge/faulty_motion.hpp"
#include "experiments/judge/reading.hpp"
#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::judge {

struct RowStates {
  /// Stores references to both arguments. The trajectory must have at least two rows.
  RowStates(const Trajectory& of, const Scenario& meant);

  /// The state of a row; positions and velocities without a column are taken from the exact path, if one is known.
  VectorX<double> state(std::size_t row, const Reading& reading) const;

  /// The scenario's start.
  VectorX<double> start(const Reading& reading) const;

  /// Distance of two states: √(attitude² + (ω / rate)²), root mean square over the bodies, at most π, rad.
  double distance(const VectorX<double>& a, const VectorX<double>& b) const;

  /// True if positions and velocities of all bodies that are not pinned are in the file or known exactly.
  bool knows_paths() const;

  /// Stride that selects at most about `count` of the spans.
  std::size_t stride_for(std::size_t count) const;

  const Trajectory& trajectory;
  const Scenario& scenario;
  FaultyMotion right;  ///< the motion of the right equations
  ExactMotion exact;
  double rate;      ///< characteristic rate of the scenario, which converts s to rad, rad/s
  double spacing;   ///< mean spacing of the rows, rad
  double span = 0;  ///< mean length of the spans, rad
  std::vector<std::pair<std::size_t, std::size_t>> spans;  ///< first and last row of each span
  /// Rows that are compared with the motion from the scenario's start, beginning with row 0; may be cleared.
  std::vector<std::size_t> first;
};

}  // namespace polhode::study::judge
