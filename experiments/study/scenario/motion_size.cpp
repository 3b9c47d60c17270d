// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/scenario/motion_size.hpp"

#include <algorithm>
#include <limits>

#include "core/exact/exact_motion.hpp"

namespace polhode::study::inline scenario {

double motion_size(const Scenario& scenario, double t_end) {
  constexpr int instants = 64;
  const auto system = make_system<double>(scenario.problem, {});
  const ExactMotion exact(*system);
  double farthest = 0;
  for (std::size_t body = 0; body < system->moving(); ++body) {
    const auto start = exact.path_at(0, body);
    for (int k = 1; start && k <= instants; ++k) {
      farthest = std::max(farthest, (exact.path_at(t_end * k / instants, body)->position - start->position).norm());
    }
  }
  return farthest > 0 ? farthest : std::numeric_limits<double>::infinity();
}

}  // namespace polhode::study::scenario
