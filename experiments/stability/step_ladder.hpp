// SPDX-License-Identifier: BSD-3-Clause
// The runs of one method on one motion by their step, each judged, and what further steps a bisection asks for.
#pragma once

#include <optional>
#include <vector>

#include "experiments/stability/critical_step.hpp"
#include "experiments/stability/followed.hpp"
#include "experiments/stability/verdict.hpp"
#include "experiments/study/curves/curves.hpp"

namespace polhode::study::stability {

/// s: as long as asked for, rounded up to whole steps, and 500 steps at least. A shortened last step would be a step of
/// another size, and growth that is slow for each step takes many of them to show.
double whole_steps(double t_end, double dt);

/// Of a run of 500 steps at least; none of a shorter one, which only says whether the motion is followed.
Verdict energy_verdict(const RunRecord& run, std::optional<double> turn);

/// A gain that stands alone is confirmed by a run so many times as long.
inline constexpr double confirmed_by = 4;

struct Ladder {
  struct Step {
    double dt = 0;                         ///< s
    std::vector<const RunRecord*> runs{};  ///< the shortest first
    Verdict verdict = Verdict::none;       ///< of the energy; none where all runs have less than 500 steps
    Lost lost = Lost::nothing;             ///< of the shortest
    const RunRecord& longest() const { return *runs.back(); }
    const RunRecord& shortest() const { return *runs.front(); }
  };
  const Curve* curve = nullptr;
  std::vector<Step> steps{};     ///< in ascending order, without refused runs
  std::optional<double> rate{};  ///< characteristic rate of the motion, rad/s
  std::optional<double> turn{};  ///< time unit of slow gains, s; absent: no gain counts as slow
  double duration = 0;           ///< time over which the motion must be followed, s
  double displacement = 0;       ///< largest displacement of the exact motion in that time, m
  bool measured = false;         ///< some run was measured against a known motion

  CriticalStep growth() const;   ///< where the energy first grows: gaining or blown up
  CriticalStep blow_up() const;  ///< where it first blows up
  CriticalStep motion() const;   ///< where the motion is first lost
};

/// Ladders of the curves of a grouping that have a run, in the order of the curves. The grouping must outlive them.
std::vector<Ladder> ladders(const Grouping& grouping);

/// The steps that halve the brackets of all ladders, side by side; where a lone verdict would decide, a longer run of
/// that step; where only a run longer than the duration asked for has lost the motion, one that is not.
std::vector<RunConfig> bisection(const StudyView& study);

}  // namespace polhode::study
