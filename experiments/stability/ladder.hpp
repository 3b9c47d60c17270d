// SPDX-License-Identifier: BSD-3-Clause
// The runs of one method on one motion by their step, each judged, and what further steps a bisection asks for.
#pragma once

#include <optional>
#include <vector>

#include "experiments/study/critical_step.hpp"
#include "experiments/study/report/curves.hpp"
#include "experiments/study/verdict.hpp"

namespace polhode::study {

/// s: as long as asked for, rounded up to whole steps, and 500 steps at least. A shortened last step would be a step of
/// another size, and growth that is slow for each step takes many of them to show.
double whole_steps(double t_end, double dt);

struct Ladder {
  struct Step {
    const RunRecord* run;
    double dt;  ///< s
    Verdict verdict;
  };
  const report::Curve* curve;
  std::vector<Step> steps{};  ///< rising; without those that were refused

  std::optional<double> rate() const;  ///< rad/s, of the motion
  CriticalStep growth() const;         ///< where the energy first grows: gaining or blown up
  CriticalStep blow_up() const;        ///< where it first blows up
};

/// Those of a grouping that have a run, in its order; the grouping must outlive them.
std::vector<Ladder> ladders(const report::Grouping& grouping);

/// The steps that halve the brackets of all ladders, side by side.
std::vector<RunConfig> bisection(const StudyView& study);

}  // namespace polhode::study
