// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "experiments/study/report/notation.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::report {

namespace {

/// Names in the catalogue's order, then names that it does not know in the order of the runs.
std::vector<std::string> methods_of(const std::vector<RunRecord>& runs) {
  std::vector<std::string> found;
  for (const auto& run : runs) {
    if (std::find(found.begin(), found.end(), run.config.integrator) == found.end()) {
      found.push_back(run.config.integrator);
    }
  }
  const auto& catalogue = integrator_catalogue();
  const auto place = [&](const std::string& name) {
    return std::find_if(catalogue.begin(), catalogue.end(), [&](const auto& e) { return e.declaration.name == name; });
  };
  std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  return found;
}

/// Which texts occur in the study for an option: it is worth naming where there are several.
class Options {
 public:
  using Describe = std::string (*)(const RunConfig&);

  Options(const std::vector<RunRecord>& runs, std::vector<Describe> all) {
    for (const auto describe : all) {
      const bool varies = std::any_of(runs.begin(), runs.end(), [&](const auto& run) {
        return describe(run.config) != describe(runs.front().config);
      });
      if (varies) varying_.push_back(describe);
    }
  }

  std::vector<std::string> describe(const RunConfig& config) const {
    std::vector<std::string> texts;
    for (const auto describe_one : varying_) {
      if (auto text = describe_one(config); !text.empty()) texts.push_back(std::move(text));
    }
    return texts;
  }

 private:
  std::vector<Describe> varying_;
};

/// How long, and seen how often, of scenarios whose runs differ in that. Scenarios of different length need no telling
/// apart by it.
class Durations {
 public:
  explicit Durations(const StudyView& study) {
    for (const auto& run : study.runs) {
      ends_[run.config.scenario].insert(study.durations_follow_steps ? 0 : run.config.t_end);
      samples_[run.config.scenario].insert(run.config.samples);
    }
  }

  std::vector<std::string> describe(const RunConfig& config) const {
    std::vector<std::string> details;
    if (ends_.at(config.scenario).size() > 1) details.push_back(fmt::format("t_end = {} s", number(config.t_end, 6)));
    if (samples_.at(config.scenario).size() > 1) {
      details.push_back(config.samples ? fmt::format("{} samples", *config.samples) : "every step seen");
    }
    return details;
  }

 private:
  std::map<std::string, std::set<double>> ends_;
  std::map<std::string, std::set<std::optional<std::int64_t>>> samples_;
};

Options variant_options(const std::vector<RunRecord>& runs) {
  return {runs,
          {[](const RunConfig& c) { return std::string(name(c.formulation.orientation)); },
           [](const RunConfig& c) { return std::string(name(c.formulation.angular_state)); },
           [](const RunConfig& c) { return fmt::format("gyroscopic {}", c.formulation.gyroscopic ? "on" : "off"); },
           [](const RunConfig& c) { return fmt::format("normalize {}", c.normalise ? "step" : "never"); },
           [](const RunConfig& c) { return fmt::format("rotation {}", name(c.formulation.rotation_from)); },
           [](const RunConfig& c) { return std::string(name(c.precision)); },
           [](const RunConfig& c) { return c.contact ? c.contact->broad_phase : std::string(); },
           [](const RunConfig& c) { return c.contact ? c.contact->narrow_phase : std::string(); },
           [](const RunConfig& c) { return c.contact ? c.contact->response : std::string(); },
           [](const RunConfig& c) { return c.contact ? c.contact->impact_timing : std::string(); },
           [](const RunConfig& c) { return c.order.value_or(0) > 0 ? fmt::format("order {}", *c.order) : std::string(); },
           [](const RunConfig& c) { return c.summation ? std::string(name(*c.summation)) : std::string(); }}};
}

/// A TOML value; of a number no more than six digits, for a range has values like 2.4000000000000004.
std::string shown_value(const std::string& text) {
  char* end = nullptr;
  const double number_in_it = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' ? number(number_in_it, 6) : text;
}

Case case_of(const RunConfig& config, const Durations& durations) {
  Case found{.scenario = config.scenario, .details = {}};
  for (const auto& varied : config.varied) {
    if (varied.value.empty()) continue;
    found.details.push_back(fmt::format("{} = {}", varied.key, shown_value(varied.value)));
  }
  for (auto& text : durations.describe(config)) found.details.push_back(std::move(text));
  return found;
}

std::string joined(const std::vector<std::string>& texts) { return fmt::format("{}", fmt::join(texts, ", ")); }

/// Tells cases apart with all digits of their values.
std::string identity(const Case& motion, const RunConfig& config) {
  std::string text = motion.label();
  for (const auto& varied : config.varied) text += '\n' + varied.key + '=' + varied.value;
  return text;
}

/// The index of a key in order of first sight.
template <class Key>
std::pair<std::size_t, bool> index_of(std::map<Key, std::size_t>& seen, const Key& key) {
  const auto [at, added] = seen.emplace(key, seen.size());
  return {at->second, added};
}

void sort_by_step(Curve& curve) {
  std::stable_sort(curve.runs.begin(), curve.runs.end(),
                   [](const auto* a, const auto* b) { return abscissa(*a).value_or(0) > abscissa(*b).value_or(0); });
}

/// Logarithms of step and value, largest step first.
using LogPoints = std::vector<std::pair<double, double>>;

LogPoints points_above_round_off(const Curve& curve, const Quantity& quantity) {
  LogPoints points;
  for (const auto* run : curve.runs) {
    const auto step = abscissa(*run);
    const auto found = value(*run, quantity);
    if (!step || !(*step > 0) || !found || *found <= round_off_level(*run, quantity)) continue;
    if (quantity.bounded && *found >= 1) continue;
    points.emplace_back(std::log(*step), std::log(*found));
  }
  return points;
}

/// The slope between a point and the one before it.
double slope_at(const LogPoints& points, std::size_t i) {
  return (points[i - 1].second - points[i].second) / (points[i - 1].first - points[i].first);
}

/// Rounding shows far above ε where energies nearly cancel or a motion is unstable: at the small steps a curve then
/// stops falling, or rises again. Takes those points away, and the last one left if rounding has begun to show in it.
void drop_floor(LogPoints& points, Precision precision) {
  const double plateau = std::log(std::min(4e6 * epsilon(precision), 1e-2));  // about 1e-9 in double
  const double highest_rise = plateau + std::log(1e4);
  constexpr double least_fall = 0.3, least_rise = 0.1;
  if (points.empty()) return;
  const auto full = points.size();
  const auto least =
      std::min_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  if (least->second < highest_rise && points.back().second > least->second + least_rise)
    points.erase(least + 1, points.end());
  while (points.size() >= 2 && points.back().second < plateau && slope_at(points, points.size() - 1) < least_fall)
    points.pop_back();
  const auto n = points.size();
  if (n < full && n >= 3 && slope_at(points, n - 1) < 0.5 * slope_at(points, n - 2)) points.pop_back();
}

}  // namespace

std::string Case::label() const {
  return details.empty() ? scenario : fmt::format("{}, {}", scenario, joined(details));
}

std::string Grouping::label(const Curve& curve) const {
  const auto& variant = variants[curve.variant_index];
  return variant.empty() ? methods[curve.method_index] : fmt::format("{} ({})", methods[curve.method_index], variant);
}

Grouping group(const StudyView& study) {
  Grouping grouping;
  grouping.methods = methods_of(study.runs);
  std::map<std::string, std::size_t> method_index, cases, variants;
  for (const auto& method : grouping.methods) method_index.emplace(method, method_index.size());
  std::map<std::tuple<std::size_t, std::size_t, std::size_t, bool>, std::size_t> curves;
  const Durations durations(study);
  const auto formulations = variant_options(study.runs);

  for (const auto& run : study.runs) {
    Case motion = case_of(run.config, durations);
    const auto [case_index, new_case] = index_of(cases, identity(motion, run.config));
    if (new_case) grouping.cases.push_back(std::move(motion));

    const auto variant = joined(formulations.describe(run.config));
    const auto [variant_index, new_variant] = index_of(variants, variant);
    if (new_variant) grouping.variants.push_back(variant);

    const auto method = method_index.at(run.config.integrator);
    const bool adaptive = run.config.tolerance.has_value();
    const auto [curve, new_curve] = index_of(curves, std::tuple(case_index, variant_index, method, adaptive));
    if (new_curve) grouping.curves.push_back({case_index, variant_index, method, adaptive, {}});
    grouping.curves[curve].runs.push_back(&run);
  }
  for (auto& curve : grouping.curves) sort_by_step(curve);
  return grouping;
}

namespace quantity {

Quantity energy_drift() {
  return {
      "energy_drift_max_rel", "energy drift", "largest energy drift (relative)", "", 0, true, [](const RunResult& r) {
        return r.energy_drift_max_rel;
      }};
}
Quantity linear_momentum_drift() {
  return {"linear_momentum_drift_max_rel",
          "linear momentum drift",
          "linear momentum drift (relative)",
          "",
          0,
          true,
          [](const RunResult& r) { return r.linear_momentum_drift_max_rel; }};
}
Quantity angular_momentum_drift() {
  return {"angular_momentum_drift_max_rel",
          "angular momentum drift",
          "angular momentum drift (relative)",
          "",
          0,
          true,
          [](const RunResult& r) { return r.angular_momentum_drift_max_rel; }};
}
Quantity orientation_defect() {
  return {
      "orientation_defect_max", "orientation defect", "orientation defect (1)", "", 0, true, [](const RunResult& r) {
        return r.orientation_defect_max;
      }};
}
Quantity position_error() {
  // A metre has no scale of its own: positions of some hundred metres carry rounding of 1e-13 m a step.
  return {"position_error_max_m",
          "position error",
          "largest position error (m)",
          " m",
          1e-10,
          false,
          [](const RunResult& r) { return r.position_error_max; }};
}
Quantity attitude_error() {
  return {"attitude_error_max_rad",
          "attitude error",
          "largest attitude error (rad)",
          " rad",
          0,
          true,
          [](const RunResult& r) { return r.attitude_error_max; }};
}
Quantity invariant_drift(const std::string& name) {
  return {name + "_drift_max_rel",
          name + " drift",
          name + " drift (relative)",
          "",
          0,
          true,
          [name](const RunResult& r) -> std::optional<double> {
            const auto at = r.invariant_drift_max_rel.find(name);
            return at == r.invariant_drift_max_rel.end() ? std::nullopt : std::optional(at->second);
          }};
}

}  // namespace quantity

std::optional<double> abscissa(const RunRecord& run) {
  return run.config.tolerance ? run.config.tolerance : run.config.dt;
}

std::string step_label(const RunRecord& run) {
  if (run.config.tolerance) return fmt::format("tolerance = {}", number(*run.config.tolerance, 6));
  return run.config.dt ? fmt::format("dt = {} s", number(*run.config.dt, 6)) : "no step";
}

std::string run_label(const Grouping& grouping, const Curve& curve, const RunRecord& run) {
  return fmt::format("{} at {}", grouping.label(curve), step_label(run));
}

bool completed(const RunRecord& run) { return run.result.status == "ok"; }
bool ended_early(const RunRecord& run) { return run.result.status == "diverged" || run.result.status == "failed"; }

std::optional<double> value(const RunRecord& run, const Quantity& quantity) {
  const auto found = completed(run) ? quantity.of(run.result) : std::nullopt;
  return found && std::isfinite(*found) ? found : std::nullopt;
}

std::string printed(const RunRecord& run, const Quantity& quantity) {
  const auto found = value(run, quantity);
  return found ? number(*found) : "";
}

double round_off_level(const RunRecord& run) {
  const auto steps = static_cast<double>(std::max<std::int64_t>(run.result.steps, 1));
  return 16 * epsilon(run.config.precision) * std::sqrt(steps);
}

double round_off_level(const RunRecord& run, const Quantity& quantity) {
  const double level = std::max(round_off_level(run), quantity.round_off);
  const auto &round_off = run.result.energy_round_off, &scale = run.result.energy_scale;
  const bool of_energy = quantity.column == "energy_drift_max_rel" && round_off && scale && *scale > 0;
  return of_energy ? std::max(level, *round_off / *scale) : level;
}

std::optional<Slope> observed_slope(const Curve& curve, const Quantity& quantity) {
  auto points = points_above_round_off(curve, quantity);
  drop_floor(points, curve.runs.front()->config.precision);
  const auto n = static_cast<double>(points.size());
  double x_mean = 0, y_mean = 0, xx = 0, xy = 0;
  for (const auto& [x, y] : points) x_mean += x / n, y_mean += y / n;
  for (const auto& [x, y] : points) xx += (x - x_mean) * (x - x_mean), xy += (x - x_mean) * (y - y_mean);
  if (points.size() < 2 || !(xx > 0)) return std::nullopt;
  return Slope{.p = xy / xx, .points = points.size()};
}

}  // namespace polhode::study::report
