// SPDX-License-Identifier: BSD-3-Clause
// Findings of a study as sentences. Every number in them is computed from the run records.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/table.hpp"

namespace polhode::study::inline report::inline findings {

struct Topic {
  std::string heading;
  std::vector<std::string> sentences;
  std::vector<Table> tables{};
};

struct Findings {
  std::string outcome;                ///< number of runs by status: "84 runs: 80 completed, 4 diverged."
  std::vector<std::string> cautions;  ///< warnings, shown first
  std::vector<Topic> topics;  ///< energy, momenta, orientation, errors, gyroscopic term, runs that did not finish
};

Findings findings_of(const StudyView& study, const Grouping& grouping);

}  // namespace polhode::study::report::findings
