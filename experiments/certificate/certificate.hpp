// SPDX-License-Identifier: BSD-3-Clause
// The certificates of a study: of each method and formulation in it every trait, declared against measured.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/certificate/finding.hpp"
#include "experiments/certificate/stage.hpp"
#include "experiments/certificate/step_traits.hpp"
#include "experiments/study/record/study_view.hpp"

namespace polhode::study::certificate {

struct Certificate {
  const IntegratorEntry* entry = nullptr;
  RunConfig config;               ///< of one of its runs; what differs between them says nothing
  std::string variant;            ///< "matrix, velocity_body"; empty where the study has one formulation
  std::vector<Finding> findings;  ///< one for each of trait_columns()
};

/// What the measurements beside the runs take from the study.
struct Measures {
  std::vector<Stage> stages;
  Course course;                          ///< that of the longest runs
  std::vector<double> steps, tolerances;  ///< those of the shortest ladders
  /// s: of maps. Half of that of the drifts, which is so large that a method does not keep by its order alone what it
  /// does not conserve.
  double map_step() const { return course.step / 2; }
};
Measures measures_of(const StudyView& study);

using FindEntry = std::function<const IntegratorEntry*(const std::string& name)>;

/// In the order of the catalogue and then of the runs; on all cores. `find`: the entry of a name, that of the catalogue
/// unless it is given.
std::vector<Certificate> certify(const StudyView& study, const Measures& measures, const FindEntry& find = {});

}  // namespace polhode::study
