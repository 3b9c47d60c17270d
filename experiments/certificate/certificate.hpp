// SPDX-License-Identifier: BSD-3-Clause
// Certificates of a study: for each method and formulation every trait, as declared and as measured.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/certificate/finding.hpp"
#include "experiments/certificate/step_traits.hpp"
#include "experiments/certificate/test_case.hpp"
#include "experiments/study/record/study_view.hpp"

namespace polhode::study::certificate {

struct Certificate {
  const IntegratorEntry* entry = nullptr;
  RunConfig config;               ///< configuration of one of its runs; only what all runs share is meaningful
  std::string variant;            ///< formulation: "matrix, velocity_body"; empty if the study has only one
  std::vector<Finding> findings;  ///< one for each trait in trait_columns()
};

/// Settings, taken from the study, of the measurements that are made in addition to the runs.
struct Measures {
  std::vector<TestCase> test_cases;
  Course course;                          ///< settings of the longest runs
  std::vector<double> steps, tolerances;  ///< steps (s) and tolerances of the runs of shortest duration
  /// Step of measured maps, s: half the step for drifts. It is large enough that a method without a trait does not
  /// appear to have it because of its order alone.
  double map_step() const { return course.step / 2; }
};
Measures measures_of(const StudyView& study);

using FindEntry = std::function<const IntegratorEntry*(const std::string& name)>;

/// Makes the certificates, in the order of the catalogue and then of the runs; uses all cores. find: returns the entry
/// of a method by name; default: find_integrator().
std::vector<Certificate> certify(const StudyView& study, const Measures& measures, const FindEntry& find = {});

}  // namespace polhode::study::certificate
