// SPDX-License-Identifier: BSD-3-Clause
#include "collision/contact/impact_search.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

namespace polhode::inline collision::inline contact {

std::optional<double> ImpactSearch::first_impact(FlightPath& path, const State<double>& start, const State<double>& end,
                                                 double length) {
  double from = 0;
  guards_.evaluate(start, at_start_);
  guards_.evaluate(end, at_end_);
  if (at_end_.least <= 0 && (guards_.some_leave() || !(at_start_.least > 0))) {
    // If pairs touch and separate at the start, the search begins at an instant at which they are apart.
    from = length;
    at_start_ = at_end_;
    for (int halvings = 0; halvings < 60 && !(at_start_.least > lengths_.met); ++halvings) {
      from *= 0.5;
      if (!path.state_at(from, there_)) break;
      guards_.evaluate(there_, at_start_);
    }
    if (!(at_start_.least > 0)) return 0;
  }
  const double first = first_below(path, from, at_start_, length, at_end_, deepest);
  return std::isfinite(first) ? std::optional(first) : std::nullopt;
}

/// First time (s) in (from, to] at which the smallest guard is zero or negative; infinity if there is none. `depth` is
/// the number of halvings left.
double ImpactSearch::first_below(FlightPath& path, double from, const Guards::Values& at_from, double to,
                                 const Guards::Values& at_to, int depth) {
  Guards::Values& seen = midpoints_[std::size_t(depth)];
  const auto value = [&](double s) {
    return path.state_at(s, there_) ? guards_.least(there_) : std::numeric_limits<double>::quiet_NaN();
  };
  if (at_from.least > 0 && at_to.least <= 0) {
    double root = to;
    if (at_to.least < 0) {
      std::uintmax_t rounds = 100;
      const auto bracket = boost::math::tools::toms748_solve(value, from, to, at_from.least, at_to.least,
                                                             boost::math::tools::eps_tolerance<double>(52), rounds);
      root = bracket.second;
    }
    const double before_root = std::max(from, root * (1 - 1e-12));
    if (depth == 0 || !path.state_at(before_root, there_)) return root;
    guards_.evaluate(there_, seen);
    if (!(seen.least > 0)) return root;
    return std::min(root, first_below(path, from, at_from, before_root, seen, depth - 1));
  }
  if (depth == 0 || !guards_.may_dip(at_from, at_to, to - from)) return std::numeric_limits<double>::infinity();
  const double middle = 0.5 * (from + to);
  if (!path.state_at(middle, there_)) return middle;  // the method fails here, so that the flight ends
  guards_.evaluate(there_, seen);
  const double first = first_below(path, from, at_from, middle, seen, depth - 1);
  return std::isfinite(first) ? first : first_below(path, middle, seen, to, at_to, depth - 1);
}

}  // namespace polhode::collision::contact
