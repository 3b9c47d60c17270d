// SPDX-License-Identifier: BSD-3-Clause
// Critical step: the smallest step at which a run no longer holds. It is searched upwards in a scan of steps, then by
// bisection.
#pragma once

#include <optional>
#include <vector>

namespace polhode::study::stability {

/// One run of a scan.
struct TriedStep {
  double dt = 0;  ///< s
  bool holds = true;
};

struct CriticalStep {
  enum class Kind {
    found,
    none,       ///< the runs of all steps tried hold
    from_start  ///< the run of the smallest step does not hold
  };
  Kind kind = Kind::none;
  double holds = 0;          ///< largest step tried below the critical one, s; all steps tried up to it hold
  double fails = 0;          ///< smallest step tried that does not hold, s
  bool holds_again = false;  ///< a larger step that was tried holds
};

/// The critical step of a scan; steps in any order, at least one. A stable window above the critical step does not
/// change the result. An unstable window is detected only if a step of the scan lies in it.
CriticalStep critical_step(std::vector<TriedStep> steps);

/// Final width of the bracket [holds, fails] over `fails`.
inline constexpr double bracket_width = 0.003;

/// The step to try next, s, which halves the bracket in its logarithm. Absent if the bracket is narrow enough or does
/// not exist.
std::optional<double> next_step(const CriticalStep& critical, double width = bracket_width);

}  // namespace polhode::study::stability
