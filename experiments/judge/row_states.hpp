// SPDX-License-Identifier: BSD-3-Clause
// The rows of a trajectory as states of the scenario's bodies, under any reading of the columns, and the choice of rows
// that are set against a motion: spans of half a radian, and rows of the first two radians.
//
// States are flat, of the formulation (quaternion, velocity_world), as in faulty_motion.hpp.
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
  /// Keeps references to both. The trajectory has two rows at least.
  RowStates(const Trajectory& of, const Scenario& meant);

  /// A row; what is not in its columns is taken from the exact path, where one is known.
  VectorX<double> state(std::size_t row, const Reading& reading) const;

  /// The scenario's start.
  VectorX<double> start(const Reading& reading) const;

  /// √(attitude² + (ω / rate)²), rad, root mean square over the bodies; π at most.
  double distance(const VectorX<double>& a, const VectorX<double>& b) const;

  /// Whether positions and velocities of all bodies that are not pinned are in the file or known exactly.
  bool knows_paths() const;

  /// The stride by which at most about `count` of the spans are taken.
  std::size_t stride_for(std::size_t count) const;

  const Trajectory& trajectory;
  const Scenario& scenario;
  FaultyMotion right;  ///< the motion of the right equations
  ExactMotion exact;
  double rate;      ///< rad/s, the scenario's characteristic rate: s times this are rad
  double spacing;   ///< rad, mean, from row to row
  double span = 0;  ///< rad, mean over the spans
  std::vector<std::pair<std::size_t, std::size_t>> spans;  ///< the row from which and the row to which
  std::vector<std::size_t>
      first;  ///< rows for a motion from the scenario's start, beginning with row 0; may be cleared
};

}  // namespace polhode::study
