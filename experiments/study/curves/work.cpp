// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/curves/work.hpp"

#include <algorithm>
#include <utility>

#include "experiments/study/curves/declared_order.hpp"
#include "experiments/study/curves/error_ladder.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline curves {
namespace {

/// True if the method solves this motion exactly, by its declaration or by errors at round-off at every step.
bool is_exact(const Curve& curve, const Quantity& quantity) {
  const RunRecord& first = *curve.runs.front();
  const auto* entry = find_integrator(first.config.integrator);
  if (entry != nullptr && !curve.adaptive && !declared_order(entry->declaration, first, quantity.unit == " rad"))
    return true;
  constexpr double near = 10;
  return curve.runs.size() > 1 && std::all_of(curve.runs.begin(), curve.runs.end(), [&](const auto* run) {
           const auto error = value(*run, quantity);
           return !completed(*run) || (error && *error <= near * round_off_level(*run, quantity));
         });
}

/// True if an error is clear of rounding: the attitude of a body that does not turn is exact with every method.
bool is_above_round_off(const Curve& curve, const Quantity& quantity) {
  constexpr double clear = 10;
  return std::any_of(curve.runs.begin(), curve.runs.end(), [&](const auto* run) {
    const auto error = value(*run, quantity);
    return ended_early(*run) || (error && *error > clear * round_off_level(*run, quantity));
  });
}

}  // namespace

RunCost cost_in_right_hand_sides() {
  return {"rhs_evaluations", "right-hand sides", "right-hand sides", " right-hand sides",
          [](const RunResult& r) { return static_cast<double>(r.evaluations); }};
}

RunCost cost_in_time() {
  return {"wall_s", "wall time", "wall time (s)", " s", [](const RunResult& r) { return r.seconds; }};
}

std::vector<WorkPoint> work_points(const Curve& curve, const Quantity& quantity, const RunCost& cost) {
  std::vector<WorkPoint> points;
  const double floor = observed_order(curve, quantity).floor;
  for (auto run = curve.runs.rbegin(); run != curve.runs.rend(); ++run) {  // from the smallest step
    const std::string& status = (*run)->result.status;
    if (status == "refused" || status == "failed" || (completed(**run) && !value(**run, quantity))) continue;
    if (!follows(**run, curve, quantity)) break;
    points.push_back(
        {std::max({*value(**run, quantity), round_off_level(**run, quantity), floor}), cost.of((*run)->result), *run});
  }
  return points;
}

std::vector<MotionWork> work_of_motions(const Grouping& grouping, const RunCost& cost) {
  std::vector<std::vector<const Curve*>> of_case(grouping.cases.size());
  for (const Curve& curve : grouping.curves) of_case[curve.case_index].push_back(&curve);
  std::vector<MotionWork> motions;
  for (std::size_t c = 0; c < grouping.cases.size(); ++c) {
    for (const auto& quantity : {quantity::attitude_error(), quantity::position_error()}) {
      MotionWork motion{.case_index = c,
                        .quantity = quantity,
                        .curves = {},
                        .points = {},
                        .exact = {},
                        .without = {},
                        .envelope = {}};
      for (const Curve* one : of_case[c]) {
        const Curve& curve = *one;
        // Runs without the gyroscopic term solve another equation.
        const bool same_equation = curve.runs.front()->config.formulation.gyroscopic;
        if (!same_equation || !is_measured(curve, quantity)) continue;
        auto work = work_points(curve, quantity, cost);
        const bool costs = std::any_of(curve.runs.begin(), curve.runs.end(),
                                       [&](const auto* run) { return cost.of(run->result) > 0; });
        if (!costs) motion.without.push_back(one);
        else if (is_exact(curve, quantity)) motion.exact.push_back(one);
        else motion.curves.push_back(one), motion.points.push_back(std::move(work));
      }
      if (std::none_of(motion.curves.begin(), motion.curves.end(),
                       [&](const Curve* curve) { return is_above_round_off(*curve, quantity); }))
        continue;
      motion.envelope = lower_envelope(motion.points, lost_level(*motion.curves.front(), quantity));
      motions.push_back(std::move(motion));
      break;
    }
  }
  return motions;
}

}  // namespace polhode::study::curves
