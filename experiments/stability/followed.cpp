// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/stability/followed.hpp"

#include <algorithm>

#include "core/exact/exact_path.hpp"
#include "experiments/study/curves/curves.hpp"

namespace polhode::study::stability {
namespace {

constexpr int path_instants = 200;

/// Errors of less than a hundred times the uncertainty of the reference are absent.
constexpr double left_out_below = 100;

bool small_by_reference(const std::optional<double>& uncertainty, double bound) {
  return uncertainty && left_out_below * *uncertainty <= bound;
}

bool all_pinned(const Problem& problem) {
  const auto end = problem.bodies.begin() + static_cast<std::ptrdiff_t>(problem.moving());
  return std::all_of(problem.bodies.begin(), end, [](const Body& body) { return body.pinned; });
}

}  // namespace

Lost what_is_lost(const RunRecord& run, double displacement) {
  const RunResult& r = run.result;
  if (r.status != "ok") return Lost::end;
  if (r.attitude_error_max.value_or(0) > followed::attitude) return Lost::attitude;
  const double position_bound = std::max(followed::position * displacement, quantity::position_error().round_off);
  if (displacement > 0 && r.position_error_max.value_or(0) > position_bound) return Lost::position;
  const double momentum =
      std::max(r.linear_momentum_drift_max_rel.value_or(0), r.angular_momentum_drift_max_rel.value_or(0));
  if (momentum > followed::momentum) return Lost::momentum;
  const auto& further = r.invariant_drift_max_rel;
  if (std::any_of(further.begin(), further.end(), [](const auto& i) { return i.second > followed::momentum; })) {
    return Lost::invariant;
  }
  if (r.orientation_defect_max.value_or(0) > followed::defect) return Lost::orientation;
  const bool energy = !has_known_motion(run) && r.energy_drift_max_rel.value_or(0) > followed::momentum;
  return energy ? Lost::energy : Lost::nothing;
}

bool has_known_motion(const RunRecord& run) {
  const RunResult& r = run.result;
  const bool attitude = r.attitude_error_max || small_by_reference(r.attitude_reference, followed::attitude);
  return attitude && (r.position_error_max || r.position_reference || all_pinned(run.scenario->problem));
}

double exact_displacement(const Problem& problem, const Formulation& formulation, double t_end) {
  const auto system = make_system<double>(problem, formulation);
  double largest = 0;
  for (std::size_t i = 0; i < problem.moving(); ++i) {
    if (problem.bodies[i].pinned) continue;
    const ExactPath path = exact_path(*system, i);
    if (!path) return 0;
    for (int k = 0; k <= path_instants; ++k) {
      largest = std::max(largest, (path(t_end * k / path_instants).position - problem.starts[i].position).norm());
    }
  }
  return largest;
}

}  // namespace polhode::study::stability
