// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/methods/ruler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/study/record/first_impact.hpp"
#include "experiments/study/scenario/characteristic_rate.hpp"
#include "experiments/study/scenario/motion_size.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::methods {
namespace {

/// The largest of the numbers that are there; absent if none is, or one is not finite.
std::optional<double> largest(std::initializer_list<std::optional<double>> numbers) {
  std::optional<double> found;
  for (const auto& x : numbers) {
    if (x && !std::isfinite(*x)) return std::nullopt;
    if (x) found = std::max(found.value_or(0), std::abs(*x));
  }
  return found;
}

}  // namespace

double characteristic_time(const RunRecord& run) {
  const auto rate = characteristic_rate(run.scenario->problem);
  return rate && *rate > 0 ? std::min(2 * std::numbers::pi / *rate, run.config.t_end) : run.config.t_end;
}

std::string motion_of(const RunConfig& config) {
  std::string text = config.scenario;
  for (const auto& varied : config.varied) {
    if (!varied.value.empty()) text += fmt::format(", {} = {}", varied.key, varied.value);
  }
  return text + fmt::format(", t_end = {} s", exact(config.t_end));
}

Ruler::Ruler(const StudyView& study) {
  for (const RunRecord& run : study.runs) {
    const std::string motion = motion_of(run.config);
    if (is_first_impact_reference(run.config)) first_impacts_[motion] = run.result.contact.first_impact;
    if (run.result.position_error_max && !sizes_.contains(motion)) {
      const double size = motion_size(*run.scenario, run.config.t_end);
      sizes_[motion] = std::isfinite(size) && size > 0 ? size : 1;
    }
  }
}

std::optional<double> Ruler::error(const RunRecord& run) const {
  if (run.result.status != "ok") return std::nullopt;
  const RunResult& r = run.result;
  const std::string motion = motion_of(run.config);
  switch (group_of(*run.scenario).measure) {
    case Measure::motion: {
      std::optional<double> position = r.position_error_max;
      if (position) *position /= sizes_.at(motion);
      return largest({r.attitude_error_max, position});
    }
    case Measure::impact: {
      const auto exact = first_impacts_.find(motion);
      if (exact == first_impacts_.end() || !exact->second || !r.energy_drift_max_rel) return std::nullopt;
      if (!r.contact.first_impact) return 1.0;  // the impact was missed
      const double late = *r.contact.first_impact - *exact->second;
      return largest({late / characteristic_time(run), r.energy_drift_max_rel});
    }
    case Measure::rest: return largest({r.contact.displacement_max, r.contact.penetration_max});
  }
  return std::nullopt;
}

bool Ruler::lacks_first_impact(const RunRecord& run) const {
  return group_of(*run.scenario).measure == Measure::impact && !first_impacts_.contains(motion_of(run.config));
}

}  // namespace polhode::study::methods
