// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/curves/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <type_traits>
#include <utility>

#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/scenario/motion_size.hpp"
#include "experiments/study/statistics/order_estimate.hpp"
#include "experiments/study/text/notation.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline curves {

namespace {

/// Names in the catalogue's order, then names that it does not have, in the order of the runs.
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

/// The variant of a run: its options that differ between the runs of the study.
class VariedOptions {
 public:
  explicit VariedOptions(const std::vector<RunRecord>& runs) {
    for (const RunOption* option : options_of_role(RunOption::Role::variant)) {
      const bool varies = std::any_of(runs.begin(), runs.end(), [&](const RunRecord& run) {
        return label_of(*option, run.config) != label_of(*option, runs.front().config);
      });
      if (varies) varying_.push_back(option);
    }
  }

  std::vector<std::string> describe(const RunConfig& config) const {
    std::vector<std::string> texts;
    for (const RunOption* option : varying_) {
      if (auto text = label_of(*option, config); !text.empty()) texts.push_back(std::move(text));
    }
    return texts;
  }

 private:
  std::vector<const RunOption*> varying_;
};

/// Duration and samples of scenarios whose runs differ in them. Scenarios of different duration are not distinguished
/// by it.
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
    if (ends_.at(config.scenario).size() > 1) details.push_back(fmt::format("t_end = {} s", rounded(config.t_end)));
    if (samples_.at(config.scenario).size() > 1) {
      details.push_back(config.samples ? fmt::format("{} samples", *config.samples) : "every step seen");
    }
    return details;
  }

 private:
  std::map<std::string, std::set<double>> ends_;
  std::map<std::string, std::set<std::optional<std::int64_t>>> samples_;
};

Case case_of(const RunConfig& config, const Durations& durations) {
  Case found{.scenario = config.scenario, .details = {}};
  for (const auto& varied : config.varied) {
    if (varied.value.empty()) continue;
    found.details.push_back(fmt::format("{} = {}", varied.key, rounded(varied.value)));
  }
  for (auto& text : durations.describe(config)) found.details.push_back(std::move(text));
  return found;
}

std::string joined(const std::vector<std::string>& texts) { return fmt::format("{}", fmt::join(texts, ", ")); }

/// A text that differs between cases, with all digits of their values.
std::string identity(const Case& motion, const RunConfig& config) {
  std::string text = motion.label();
  for (const auto& varied : config.varied) text += '\n' + varied.key + '=' + varied.value;
  return text;
}

/// The index of a key in the order of first appearance.
template <class Key>
std::pair<std::size_t, bool> index_of(std::map<Key, std::size_t>& seen, const Key& key) {
  const auto [at, added] = seen.emplace(key, seen.size());
  return {at->second, added};
}

void sort_by_step(Curve& curve) {
  std::stable_sort(curve.runs.begin(), curve.runs.end(),
                   [](const auto* a, const auto* b) { return abscissa(*a).value_or(0) > abscissa(*b).value_or(0); });
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
  std::vector<std::optional<double>> sizes;  // extent of the motion of each case with measured positions, m
  const Durations durations(study);
  const VariedOptions options(study.runs);

  for (const auto& run : study.runs) {
    Case motion = case_of(run.config, durations);
    const auto [case_index, new_case] = index_of(cases, identity(motion, run.config));
    if (new_case) {
      grouping.cases.push_back(std::move(motion));
      sizes.emplace_back();
    }
    if (!sizes[case_index] && run.scenario && run.result.position_error_max) {
      sizes[case_index] = motion_size(*run.scenario, run.config.t_end);
    }

    const auto variant = joined(options.describe(run.config));
    const auto [variant_index, new_variant] = index_of(variants, variant);
    if (new_variant) grouping.variants.push_back(variant);

    const auto method = method_index.at(run.config.integrator);
    const bool adaptive = run.config.tolerance.has_value();
    const auto [curve, new_curve] = index_of(curves, std::tuple(case_index, variant_index, method, adaptive));
    if (new_curve) {
      Curve& added = grouping.curves.emplace_back();
      added.case_index = case_index;
      added.variant_index = variant_index;
      added.method_index = method;
      added.adaptive = adaptive;
    }
    grouping.curves[curve].runs.push_back(&run);
  }
  for (auto& curve : grouping.curves) {
    if (const auto& size = sizes[curve.case_index]) curve.motion_size = *size;
    sort_by_step(curve);
  }
  return grouping;
}

namespace quantity {
namespace {

/// The quantity of a metric; `axis` is the label of its axis without the unit.
Quantity of_metric(const Metric& metric, std::string words, const std::string& axis) {
  return {.column = metric.column,
          .words = std::move(words),
          .axis = fmt::format("{} ({})", axis, metric.unit),
          .unit = metric.unit == "relative" || metric.unit == "1" ? "" : " " + metric.unit,
          .of = [&metric](const RunResult& result) {
            std::optional<double> number;
            with_value(metric, result, [&]<class Value>(const Value& value) {
              if constexpr (std::is_same_v<Value, std::optional<double>>) number = value;
            });
            return number;
          }};
}

}  // namespace

Quantity energy_drift() {
  Quantity drift = of_metric(metric_of_column("energy_drift_max_rel"), "energy drift", "largest energy drift");
  drift.round_off_of = [](const RunResult& r) -> std::optional<double> {
    if (!r.energy_round_off || !r.energy_scale) return std::nullopt;
    return *r.energy_round_off / *r.energy_scale;
  };
  return drift;
}
Quantity linear_momentum_drift() {
  return of_metric(metric_of_column("linear_momentum_drift_max_rel"), "linear momentum drift", "linear momentum drift");
}
Quantity angular_momentum_drift() {
  return of_metric(metric_of_column("angular_momentum_drift_max_rel"), "angular momentum drift",
                   "angular momentum drift");
}
Quantity orientation_defect() {
  return of_metric(metric_of_column("orientation_defect_max"), "orientation defect", "orientation defect");
}
Quantity position_error() {
  Quantity error = of_metric(metric_of_column("position_error_max_m"), "position error", "largest position error");
  error.round_off = 1e-10;  // positions of some hundred metres carry rounding of 1e-13 m a step
  error.bounded = false;    // a metre has no scale of its own
  error.of_place = true;
  return error;
}
Quantity velocity_error() {
  Quantity error =
      of_metric(metric_of_column("velocity_error_max_m_per_s"), "velocity error", "largest velocity error");
  error.bounded = false;
  return error;
}
Quantity reaction_error() {
  Quantity error =
      of_metric(metric_of_column("joint_reaction_error_max_N"), "error of reactions", "largest error of a reaction");
  error.bounded = false;
  return error;
}
Quantity attitude_error() {
  return of_metric(metric_of_column("attitude_error_max_rad"), "attitude error", "largest attitude error");
}
Quantity invariant_drift(const std::string& name) {
  const Metric& metric = metric_of_column("invariant_drifts_max_rel");
  Quantity drift = of_metric(metric, name + " drift", name + " drift");
  drift.column = csv_columns(metric, {name}).front();
  drift.of = [name](const RunResult& r) -> std::optional<double> {
    const auto at = r.invariant_drift_max_rel.find(name);
    return at == r.invariant_drift_max_rel.end() ? std::nullopt : std::optional(at->second);
  };
  return drift;
}

}  // namespace quantity

std::optional<double> abscissa(const RunRecord& run) {
  return run.config.tolerance ? run.config.tolerance : run.config.dt;
}

std::string step_label(const RunRecord& run) {
  if (run.config.tolerance) return fmt::format("tolerance = {}", rounded(*run.config.tolerance));
  return run.config.dt ? fmt::format("dt = {} s", rounded(*run.config.dt)) : "no step";
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

bool is_measured(const Curve& curve, const Quantity& quantity) {
  return std::any_of(curve.runs.begin(), curve.runs.end(), [&](const auto* run) { return value(*run, quantity); });
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
  const auto own = quantity.round_off_of ? quantity.round_off_of(run.result) : std::nullopt;
  return std::max({round_off_level(run), quantity.round_off, own.value_or(0)});
}

double lost_level(const Curve& curve, const Quantity& quantity) {
  if (quantity.bounded) return motion_lost;
  return quantity.of_place ? curve.motion_size : std::numeric_limits<double>::infinity();
}

bool follows(const RunRecord& run, const Curve& curve, const Quantity& quantity) {
  const auto found = value(run, quantity);
  return found && *found < lost_level(curve, quantity);
}

bool off_the_motion(const RunRecord& run, const Curve& curve) {
  for (const auto& quantity : {quantity::attitude_error(), quantity::position_error()}) {
    if (value(run, quantity) && !follows(run, curve, quantity)) return true;
  }
  return false;
}

}  // namespace polhode::study::curves
