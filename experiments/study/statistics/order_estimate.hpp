// SPDX-License-Identifier: BSD-3-Clause
// The order p at which an error falls, error ∝ step^p, from a ladder of steps: a straight line fitted by least squares
// to the logarithms over the asymptotic stretch, with its standard error and 95 % confidence interval.
//
// The asymptotic stretch begins at the smallest step at which rounding does not show and grows towards larger steps as
// long as the points stay on one straight line. Left out are
//   blown up:      steps at and above the smallest one whose run has no finite error or one of `lost` or more;
//   round-off:     errors below ten times what rounding alone may add up to in that run, and, below √ε, the smallest
//                  steps at which the error no longer falls (slope under `least_fall` from the step before, or from the
//                  one before that) with all errors below ten times theirs;
//   not straight:  the largest steps, from the first one on that would put a point further than `straightness` from the
//                  fitted line.
// The interval is that of Student's t with points − 2 degrees of freedom: it says how well the points lie on a line.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace polhode::study::inline statistics {

/// rad of an attitude, or 1 of what is relative: from here on the motion is lost. Angles beyond are wrapped or
/// saturated, and which of two is the less is chance.
inline constexpr double motion_lost = 1;
/// From half of that on an error bends away from a power law, and tells no order.
inline constexpr double lost_to_fits = 0.5 * motion_lost;

struct LadderPoint {
  double step = 0;       ///< or a tolerance; positive
  double error = 0;      ///< not finite: the motion is lost, or the run diverged or failed
  double round_off = 0;  ///< what rounding alone may add up to in that run; infinite: no digit of the error is proven
};

struct OrderSettings {
  double lost = std::numeric_limits<double>::infinity();  ///< an error of this size says that the motion is lost
  double epsilon = std::numeric_limits<double>::epsilon();
  double straightness = 0.1;  ///< of ln(error)
  double least_fall = 0.5;    ///< the lowest order is 1
};

/// A method that chooses its steps does not follow a line as closely as one that is given them: the whole ladder
/// counts.
inline constexpr OrderSettings of_chosen_steps = {.straightness = std::numeric_limits<double>::infinity(),
                                                  .least_fall = 0};

/// Of a line that tells an order: half its 95 % confidence interval at most.
inline constexpr double widest_order_interval = 0.5;

struct OrderEstimate {
  struct Line {
    double order = 0;
    double standard_error = 0;
    double half_width_95 = 0;  ///< of the confidence interval
  };
  std::optional<Line> line;  ///< absent with fewer than three points
  bool straight = false;     ///< no point is further than `straightness` from the line
  double floor = 0;        ///< the largest error, below √ε, of the smallest steps at which the error no longer falls
  bool exact = false;      ///< every error that was not blown up is round-off
  std::size_t points = 0;  ///< behind the line, or that there are for one
  double smallest = 0, largest = 0;                              ///< the steps of the stretch
  std::size_t blown_up = 0, at_round_off = 0, not_straight = 0;  ///< points left out
};

OrderEstimate estimate_order(std::vector<LadderPoint> points, const OrderSettings& settings = {});

enum class OrderVerdict { as_declared, higher, lower, exact_here, too_few, scattered };
std::string word_of(OrderVerdict verdict);

/// `declared` is compared with the observed order to within 0.25; an interval wider than ±0.5, or one that holds an
/// order further off than that, decides nothing. nullopt: it declares to be exact. Exact here: it is, and did not
/// declare it.
OrderVerdict judge(const OrderEstimate& estimate, std::optional<double> declared);

}  // namespace polhode::study
