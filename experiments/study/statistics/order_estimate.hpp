// SPDX-License-Identifier: BSD-3-Clause
// The order p of convergence, error ∝ step^p, from a ladder of steps: a straight line fitted by least squares to the
// logarithms in the asymptotic range, with its standard error and 95 % confidence interval.
//
// The asymptotic range begins at the smallest step without visible rounding and extends to larger steps as long as the
// points lie on one straight line. Points left out:
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

/// Error level (rad of an attitude, or 1 of a relative quantity) from which the motion is lost: angles are wrapped or
/// saturated there, and the smaller of two errors is smaller by chance.
inline constexpr double motion_lost = 1;
/// Share of that level from which the error deviates from a power law; such errors are not fitted.
inline constexpr double lost_to_fits = 0.5 * motion_lost;

struct LadderPoint {
  double step = 0;       ///< step or tolerance; positive
  double error = 0;      ///< error; not finite: the motion is lost, or the run diverged or failed
  double round_off = 0;  ///< upper limit of the rounding error of that run; +inf: no digit of the error is proven
};

struct OrderSettings {
  double lost = std::numeric_limits<double>::infinity();  ///< errors of this size mean that the motion is lost
  double epsilon = std::numeric_limits<double>::epsilon();
  double straightness = 0.1;  ///< largest residual of ln(error)
  double least_fall = 0.5;    ///< smallest slope that counts as falling; the lowest order is 1
};

/// Settings for adaptive methods, whose errors follow a line less closely: the whole ladder is fitted.
inline constexpr OrderSettings of_chosen_steps = {.straightness = std::numeric_limits<double>::infinity(),
                                                  .least_fall = 0};

/// Largest half width of the 95 % confidence interval of a conclusive order.
inline constexpr double widest_order_interval = 0.5;

struct OrderEstimate {
  struct Line {
    double order = 0;
    double standard_error = 0;
    double half_width_95 = 0;  ///< half the 95 % confidence interval of the slope
  };
  std::optional<Line> line;  ///< line through the points; absent with fewer than three
  bool straight = false;     ///< no point is further than `straightness` from the line
  double floor = 0;          ///< largest error, below √ε, of the smallest steps at which the error no longer falls
  bool exact = false;        ///< every error that is not blown up is round-off
  std::size_t points = 0;    ///< points of the line, or points available for one
  double smallest = 0, largest = 0;                              ///< the steps at the ends of the range
  std::size_t blown_up = 0, at_round_off = 0, not_straight = 0;  ///< points left out
};

OrderEstimate estimate_order(std::vector<LadderPoint> points, const OrderSettings& settings = {});

enum class OrderVerdict { as_declared, higher, lower, exact_here, too_few, scattered };
std::string word_of(OrderVerdict verdict);

/// `declared` is compared with the observed order to within 0.25; an interval wider than ±0.5, or one that holds an
/// order further off than that, decides nothing. nullopt: it declares to be exact. Exact here: it is, and did not
/// declare it.
OrderVerdict order_verdict(const OrderEstimate& estimate, std::optional<double> declared);

}  // namespace polhode::study::statistics
