// SPDX-License-Identifier: BSD-3-Clause
// The steps and tolerances at which each method is run: halved, or a tenth, until the error is below the smallest
// target or the budget is spent.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "experiments/methods/ruler.hpp"
#include "experiments/study/record/study_view.hpp"

namespace polhode::study::methods {

/// Right-hand sides per characteristic time that a run may cost.
inline constexpr double budget = 2e4;
/// Errors for which costs are found: 10^-2 … 10^-10.
inline constexpr int first_decade = -2, last_decade = -10;
inline constexpr std::size_t targets = first_decade - last_decade + 1;
double target(std::size_t k);           ///< 10^(first_decade − k)
std::string error_text(std::size_t k);  ///< "1e-6"

/// Number of samples of each run of a ladder, so that all measure the same instants. Its steps are t_end/(samples 2^k).
inline constexpr int samples = 32;

/// True for a run of a ladder. The runs of the plan itself only name the methods and formulations.
bool is_of_ladder(const RunConfig& config);

/// The runs of one method in one formulation on one motion.
struct Rungs {
  std::string key;                       ///< configuration without step, tolerance and samples
  const RunRecord* any = nullptr;        ///< one of them
  std::vector<const RunRecord*> runs{};  ///< largest step or loosest tolerance first; those of the ladder
};

/// The ladders of a study in the order of its runs, which must outlive them. Runs without the gyroscopic term solve
/// another equation and have none.
std::vector<Rungs> ladders(const StudyView& study);

/// The next rungs of all ladders, and the runs that give the first impacts.
std::vector<RunConfig> next_rungs(const StudyView& study);

}  // namespace polhode::study::methods
