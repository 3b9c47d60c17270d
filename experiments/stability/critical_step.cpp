// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/stability/critical_step.hpp"

#include <algorithm>
#include <cmath>

namespace polhode::study::stability {

CriticalStep critical_step(std::vector<TriedStep> steps) {
  std::sort(steps.begin(), steps.end(), [](const auto& a, const auto& b) { return a.dt < b.dt; });
  CriticalStep found;
  const auto first = std::find_if(steps.begin(), steps.end(), [](const auto& s) { return !s.holds; });
  if (first == steps.end()) {
    found.holds = steps.back().dt;
    return found;
  }
  found.fails = first->dt;
  found.holds_again = std::any_of(first, steps.end(), [](const auto& s) { return s.holds; });
  found.kind = first == steps.begin() ? CriticalStep::Kind::from_start : CriticalStep::Kind::found;
  if (first != steps.begin()) found.holds = (first - 1)->dt;
  return found;
}

std::optional<double> next_step(const CriticalStep& critical, double width) {
  if (critical.kind != CriticalStep::Kind::found) return std::nullopt;
  if (critical.fails - critical.holds <= width * critical.fails) return std::nullopt;
  return std::sqrt(critical.holds * critical.fails);
}

}  // namespace polhode::study::stability
