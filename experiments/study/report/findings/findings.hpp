// SPDX-License-Identifier: BSD-3-Clause
// What is seen in a study, in words. Every number in them is computed from the records.
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
  std::string outcome;                ///< "84 runs: 80 completed, 4 diverged."
  std::vector<std::string> cautions;  ///< what must not be overlooked
  std::vector<Topic> topics;  ///< energy, momenta, orientation, errors, gyroscopic term, runs that did not finish
};

Findings findings_of(const StudyView& study, const Grouping& grouping);

}  // namespace polhode::study::report
