// SPDX-License-Identifier: BSD-3-Clause
// Error of runs against their cost: which curves of a motion compete, and the lower envelope of those that do.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/curves/envelope.hpp"

namespace polhode::study::inline curves {

/// A measure of the cost of a run.
struct RunCost {
  std::string column, words, axis, unit;  ///< "wall_s", "wall time", "wall time (s)", " s"
  double (*of)(const RunResult&);
};
RunCost cost_in_right_hand_sides();
RunCost cost_in_time();

/// Curves of one motion in all formulations, with their lower envelope. The error is that of the attitude or, for a
/// motion without one, that of the position.
struct MotionWork {
  std::size_t case_index = 0;
  Quantity quantity;
  std::vector<const Curve*> curves;            ///< curves that compete
  std::vector<std::vector<WorkPoint>> points;  ///< work_points() of each of them
  std::vector<const Curve*> exact;             ///< those of methods that solve the motion exactly
  std::vector<const Curve*> without;           ///< those without a measured cost
  std::vector<EnvelopePoint> envelope;
};

/// Error and cost of the runs below the smallest step that does not follow the motion; larger steps agree with it only
/// by chance. Errors below the round-off level of the run, or below the floor at which the errors of the curve no
/// longer decrease, are raised to it.
std::vector<WorkPoint> work_points(const Curve& curve, const Quantity& quantity, const RunCost& cost);

/// The motions for which an error above rounding was measured. Runs without the gyroscopic term solve another equation
/// and do not compete.
std::vector<MotionWork> work_of_motions(const Grouping& grouping, const RunCost& cost);

}  // namespace polhode::study::curves
