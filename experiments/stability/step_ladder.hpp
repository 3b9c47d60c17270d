// SPDX-License-Identifier: BSD-3-Clause
// Ladder of steps: the runs of one method on one motion, sorted by step, with a verdict for each step; and the further
// steps that a bisection requires.
#pragma once

#include <optional>
#include <vector>

#include "experiments/stability/critical_step.hpp"
#include "experiments/stability/followed.hpp"
#include "experiments/stability/verdict.hpp"
#include "experiments/study/curves/curves.hpp"

namespace polhode::study::stability {

/// Duration of a run, s: t_end rounded up to whole steps, at least 500 steps. A shortened last step would be a step of
/// another size, and a slow growth per step shows only after many steps.
double whole_steps(double t_end, double dt);

/// Verdict on the energy of a run of at least 500 steps; `none` for a shorter run, which only shows whether the motion
/// is followed. turn: as for stability_verdict().
Verdict energy_verdict(const RunRecord& run, std::optional<double> turn);

/// Duration of the run that confirms an isolated gain, over that of the first run.
inline constexpr double confirmed_by = 4;

struct Ladder {
  struct Step {
    double dt = 0;                         ///< s
    std::vector<const RunRecord*> runs{};  ///< runs in ascending order of duration
    Verdict verdict = Verdict::none;       ///< verdict on the energy; `none` if all runs have less than 500 steps
    Lost lost = Lost::nothing;             ///< quantity lost in the shortest run
    const RunRecord& longest() const { return *runs.back(); }
    const RunRecord& shortest() const { return *runs.front(); }
  };
  const Curve* curve = nullptr;
  std::vector<Step> steps{};     ///< steps in ascending order, without refused runs
  std::optional<double> rate{};  ///< characteristic rate of the motion, rad/s
  std::optional<double> turn{};  ///< time unit of slow gains, s; absent: no gain counts as slow
  double duration = 0;           ///< time over which the motion must be followed, s
  double displacement = 0;       ///< largest displacement of the exact motion in that time, m
  bool measured = false;         ///< some run was measured against a known motion

  CriticalStep growth() const;   ///< critical step of energy growth: verdict gaining or blown up
  CriticalStep blow_up() const;  ///< critical step of the verdict blown up
  CriticalStep motion() const;   ///< critical step at which the motion is lost
};

/// Ladders of the curves of a grouping that have a run, in the order of the curves. The grouping must outlive them.
std::vector<Ladder> ladders(const Grouping& grouping);

/// Further runs for the bisection of all ladders: one for the step that halves each bracket. Exceptions: if an isolated
/// gain would decide, a longer run of its step; if a run longer than the requested duration has lost the motion, a run
/// of the requested duration.
std::vector<RunConfig> bisection(const StudyView& study);

}  // namespace polhode::study::stability
