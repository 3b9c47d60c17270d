// SPDX-License-Identifier: BSD-3-Clause
// The critical step: the smallest step at which a run no longer holds, looked for from below on a scan, then by
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
    none,       ///< every step tried holds
    from_start  ///< not even the smallest one does
  };
  Kind kind = Kind::none;
  double holds = 0;          ///< s, the largest step below the critical one that was tried; it and all below it hold
  double fails = 0;          ///< s, the smallest step that does not hold
  bool holds_again = false;  ///< a larger step that was tried does
};

/// Steps in any order, at least one. A stable window above the critical step does not hide it, nor does an unstable one
/// that the scan has seen; one that lies between two steps of the scan is not seen.
CriticalStep critical_step(std::vector<TriedStep> steps);

/// How narrow the bracket [holds, fails] is made, relative to `fails`.
inline constexpr double bracket_width = 0.003;

/// The step to try next, so that the bracket is halved (in its logarithm); absent: narrow enough, or none.
std::optional<double> next_step(const CriticalStep& critical, double width = bracket_width);

}  // namespace polhode::study
