// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/certificate/run_traits.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "experiments/certificate/order_finding.hpp"
#include "experiments/certificate/step_traits.hpp"
#include "experiments/study/curves/declared_order.hpp"
#include "experiments/study/curves/error_ladder.hpp"

namespace polhode::study::certificate {
namespace {

/// The runs on which the traits of one motion are measured.
struct Motion {
  const TestCase* test_case = nullptr;
  const Scenario* scenario = nullptr;
  const Curve* ladder = nullptr;       ///< shortest curve of at least three steps; null: none
  const RunRecord* longest = nullptr;  ///< run of the largest step of the longest curve
};

double duration(const Curve& curve) { return curve.runs.front()->config.t_end; }

/// The motions of the curves: one for each scenario and values of varied keys.
std::vector<Motion> motions_of(const std::vector<const Curve*>& curves, const std::vector<TestCase>& test_cases,
                               const std::vector<Scenario>& scenarios) {
  std::map<std::string, Motion> motions;
  for (const Curve* curve : curves) {
    const RunConfig& config = curve->runs.front()->config;
    const auto test_case = std::find_if(test_cases.begin(), test_cases.end(),
                                        [&](const TestCase& t) { return t.name == config.scenario; });
    const auto scenario =
        std::find_if(scenarios.begin(), scenarios.end(), [&](const Scenario& s) { return s.name == config.scenario; });
    if (test_case == test_cases.end() || scenario == scenarios.end()) continue;
    std::string key = config.scenario;
    for (const Override& varied : config.varied) key += '\n' + varied.key + '=' + varied.value;
    Motion& motion = motions[key];
    motion.test_case = &*test_case;
    motion.scenario = &*scenario;
    constexpr std::size_t least_steps = 3;
    if (curve->runs.size() >= least_steps && (!motion.ladder || duration(*curve) < duration(*motion.ladder))) {
      motion.ladder = curve;
    }
    if (!motion.longest || duration(*curve) > motion.longest->config.t_end) motion.longest = curve->runs.front();
  }
  std::vector<Motion> all;
  for (auto& [key, motion] : motions) all.push_back(motion);
  return all;
}

class RunTraits {
 public:
  RunTraits(const Subject& subject, std::vector<Motion> motions) : subject_(subject), motions_(std::move(motions)) {
    for (const Motion& motion : motions_) longest_ = std::max(longest_, motion.longest->config.t_end);
  }

  Finding order(const std::string& trait, bool free) const {
    std::vector<Finding> findings;
    for (const Motion& motion : motions_) {
      if (motion.test_case->free != free || !motion.ladder) continue;
      const auto attitude = quantity::attitude_error(), position = quantity::position_error();
      if (declared(motion, true) == declared(motion, false)) {
        findings.push_back(order_on(trait, motion, {attitude, position}));
      } else {
        findings.push_back(order_on(trait, motion, {attitude}));
        findings.push_back(order_on(trait, motion, {position}));
      }
    }
    return findings.empty()
               ? not_applicable(trait, free ? "no ladder of steps without forces" : "no ladder of steps under forces")
               : worst(findings);
  }

  using Drift = std::function<std::optional<double>(const RunResult&)>;

  Finding drift(const std::string& trait, std::optional<bool> declared, const std::string& none,
                const std::function<bool(const TestCase&)>& select, const Drift& of) const {
    std::vector<Finding> findings;
    for (const Motion& motion : motions_) {
      if (motion.longest->config.t_end < longest_) continue;  // this motion was run only for its order
      if (select(*motion.test_case)) findings.push_back(drift_on(trait, declared, *motion.longest, of));
    }
    return findings.empty() ? not_applicable(trait, none) : worst(findings);
  }

 private:
  static Finding without_run(const std::string& trait, const RunRecord& run) {
    Finding finding = not_applicable(trait, run.result.message);
    finding.on = run.config.scenario;
    if (run.result.status != "refused") finding.verdict = TraitVerdict::undecided;
    return finding;
  }

  std::optional<double> declared(const Motion& motion, bool attitude) const {
    return declared_order(subject_.declaration(), *motion.scenario, attitude);
  }

  static bool seen_in(const Curve& curve, const Quantity& quantity) {
    return std::any_of(curve.runs.begin(), curve.runs.end(),
                       [&](const auto* run) { return quantity.of(run->result).has_value(); });
  }

  /// The ladder of the largest error of all quantities, in rad or m.
  static std::vector<LadderPoint> largest_errors(const Curve& curve, const std::vector<Quantity>& quantities) {
    std::vector<LadderPoint> all;
    for (const Quantity& quantity : quantities) {
      auto ladder = error_ladder(curve, quantity);
      if (all.empty()) all = ladder;
      for (std::size_t k = 0; k < all.size(); ++k) {
        if (!(ladder[k].error <= all[k].error)) all[k] = ladder[k];
      }
    }
    return all;
  }

  Finding order_on(const std::string& trait, const Motion& motion, std::vector<Quantity> quantities) const {
    const RunRecord& run = *motion.ladder->runs.front();
    if (run.result.status == "refused") return without_run(trait, run);
    std::erase_if(quantities, [&](const Quantity& q) { return !seen_in(*motion.ladder, q); });
    Finding finding;
    if (quantities.empty()) {
      finding = not_applicable(trait, "no exact motion is known; --reference makes one");
    } else {
      const Declaration& d = subject_.declaration();
      const bool attitude = quantities.front().unit == quantity::attitude_error().unit;
      const auto order = declared(motion, attitude);
      auto settings = order_settings(d.adaptive);
      settings.epsilon = epsilon(run.config.precision);
      auto ladder = largest_errors(*motion.ladder, quantities);
      if (!motion.test_case->free) {  // sums of forces and torques have larger rounding errors
        for (LadderPoint& point : ladder) point.round_off *= 4;
      }
      // Every method computes the position of a body at rest, or on a straight line, exactly.
      const bool trivial = !attitude && order && estimate_order(ladder, settings).exact;
      finding = trivial ? not_applicable(trait, "no method gets the path of the mass centre wrong")
                        : order_finding(trait, d.adaptive, order ? static_cast<int>(*order) : Declaration::exact_order,
                                        std::move(ladder), settings);
    }
    finding.on = run.config.scenario;
    return finding;
  }

  static Finding drift_on(const std::string& trait, std::optional<bool> declared, const RunRecord& run,
                          const Drift& of) {
    if (run.result.status == "refused") return without_run(trait, run);
    const double limit = kept_limit * epsilon(run.config.precision) / std::numeric_limits<double>::epsilon();
    const auto most = of(run.result);
    // A run that ended early counts until its end, unless it ended within the first steps with a small drift.
    constexpr std::int64_t least_steps = 10;
    if (!most || (*most <= limit && run.result.steps < least_steps)) return without_run(trait, run);
    Finding finding = kept(trait, declared.value_or(false), *most, limit, run.config.scenario);
    if (!declared) finding.declared.clear();
    if (run.result.status != "ok") finding.note = run.result.status + ": " + run.result.message;
    return finding;
  }

  const Subject& subject_;
  std::vector<Motion> motions_;
  double longest_ = 0;  ///< duration of the longest motion, s
};

}  // namespace

std::vector<Finding> run_traits(const Subject& subject, const std::vector<const Curve*>& curves,
                                const std::vector<TestCase>& test_cases, const std::vector<Scenario>& scenarios) {
  const Declaration& d = subject.declaration();
  const auto motions = motions_of(curves, test_cases, scenarios);
  const RunTraits traits(subject, motions);
  const auto free = [](const TestCase& t) { return t.free; };
  const auto conservative = [](const TestCase& t) { return t.conservative; };
  const auto any = [](const TestCase&) { return true; };
  const auto energy = [](const RunResult& r) { return r.energy_drift_max_rel; };

  // ½ Ω·IΩ is quadratic in the body's angular velocity.
  const bool quadratic_energy =
      d.conserves_quadratics && subject.formulation.angular_state == AngularState::velocity_body;
  Finding forced =
      traits.drift("energy_forced", std::nullopt, "no forces that all have a potential", conservative, energy);
  for (const Motion& motion : motions) {
    if (motion.test_case->name != forced.on || motion.longest->result.status != "ok") continue;
    forced.note = motion.longest->result.drift_class;
  }
  return {traits.order("order_free", true),
          traits.order("order_forced", false),
          traits.drift("energy_free", d.conserves_energy || quadratic_energy, "no body without forces", free, energy),
          std::move(forced),
          traits.drift("angular_momentum", d.conserves_momentum, "no body without forces", free,
                       [](const RunResult& r) { return r.angular_momentum_drift_max_rel; }),
          traits.drift("orientation", d.lie_group || d.normalizes || d.conserves_quadratics, "no run", any,
                       [](const RunResult& r) { return r.orientation_defect_max; })};
}

}  // namespace polhode::study::certificate
