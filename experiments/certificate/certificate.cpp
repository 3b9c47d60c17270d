// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/certificate/certificate.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "experiments/certificate/run_traits.hpp"
#include "experiments/study/curves/curves.hpp"

namespace polhode::study::certificate {
namespace {

constexpr int many_steps = 20;

/// The findings in the order of trait_columns().
std::vector<Finding> in_order(std::vector<Finding> findings) {
  std::vector<Finding> sorted;
  for (const TraitColumn& column : trait_columns()) {
    const auto found =
        std::find_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.trait == column.trait; });
    sorted.push_back(found == findings.end() ? not_applicable(column.trait, "not measured") : std::move(*found));
  }
  return sorted;
}

/// Replaces findings on traits that runs without the gyroscopic term cannot have: they solve another equation.
void drop_what_needs_the_full_equations(std::vector<Finding>& findings) {
  const std::set<std::string> left = {"time_reversibility", "time_reversibility_many", "orientation",
                                      "evaluations_per_step"};
  for (Finding& finding : findings) {
    if (left.contains(finding.trait)) continue;
    finding = not_applicable(finding.trait, "without the gyroscopic term another equation is solved");
  }
}

}  // namespace

Measures measures_of(const StudyView& study) {
  Measures measures{.test_cases = test_cases_of(study.scenarios), .course = {}, .steps = {}, .tolerances = {}};
  double longest = 0;
  std::map<double, std::set<double>> steps, tolerances;  // steps and tolerances by duration
  for (const RunRecord& run : study.runs) {
    longest = std::max(longest, run.config.t_end);
    if (run.config.dt) steps[run.config.t_end].insert(*run.config.dt);
    if (run.config.tolerance) tolerances[run.config.t_end].insert(*run.config.tolerance);
  }
  measures.course.t_end = longest;
  if (const auto found = steps.find(longest); found != steps.end()) measures.course.step = *found->second.rbegin();
  if (const auto found = tolerances.find(longest); found != tolerances.end()) {
    measures.course.tolerance = *found->second.rbegin();
  }
  const auto ladder = [](const std::map<double, std::set<double>>& all) {
    return all.empty() ? std::vector<double>()
                       : std::vector<double>(all.begin()->second.begin(), all.begin()->second.end());
  };
  measures.steps = ladder(steps);
  measures.tolerances = ladder(tolerances);
  return measures;
}

std::vector<Certificate> certify(const StudyView& study, const Measures& measures, const FindEntry& find) {
  const Grouping grouping = group(study);
  std::map<std::pair<std::size_t, std::size_t>, std::vector<const Curve*>> curves;
  for (const Curve& curve : grouping.curves) curves[{curve.method_index, curve.variant_index}].push_back(&curve);

  std::vector<Certificate> certificates;
  std::vector<const std::vector<const Curve*>*> runs;
  for (const auto& [key, of_subject] : curves) {
    const RunConfig& config = of_subject.front()->runs.front()->config;
    const auto* entry = find ? find(config.integrator) : find_integrator(config.integrator);
    if (entry == nullptr) continue;
    certificates.push_back({entry, config, grouping.variants[key.second], {}});
    runs.push_back(&of_subject);
  }
  const ShakenMotions shaken(measures.test_cases);
  const auto certify_one = [&](std::size_t i) {
    Certificate& c = certificates[i];
    const Subject subject{*c.entry, c.config.formulation};
    const auto& [test_cases, course, steps, tolerances] = measures;
    auto findings = run_traits(subject, *runs[i], test_cases, study.scenarios);
    findings.push_back(shaken.order(subject, steps, tolerances));
    findings.push_back(time_reversibility(subject, test_cases, measures.map_step()));
    findings.push_back(time_reversibility(subject, test_cases, measures.map_step(), many_steps));
    findings.push_back(symplecticity(subject, test_cases, measures.map_step()));
    findings.push_back(casimir(subject, test_cases, course));
    findings.push_back(evaluations_per_step(subject, test_cases, course));
    if (!c.config.formulation.gyroscopic) drop_what_needs_the_full_equations(findings);
    c.findings = in_order(std::move(findings));
  };
  tbb::parallel_for(std::size_t{0}, certificates.size(), certify_one);
  return certificates;
}

}  // namespace polhode::study::certificate
