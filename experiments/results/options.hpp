// SPDX-License-Identifier: BSD-3-Clause
// Command line of `results`.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "experiments/results/output.hpp"

namespace polhode::study::results {

struct ResultsOptions {
  bool best = false;                 ///< true for the command results best …
  std::vector<std::string> folders;  ///< folders of results, one at least
  bool list = false;                 ///< print the names of all columns
  std::vector<std::string> where;
  /// Names of columns as written, without blanks; empty: not given.
  std::vector<std::string> columns, sort, group, show;
  std::optional<std::size_t> limit{};  ///< largest number of rows
  std::optional<Format> format{};
  std::string out;                   ///< file; empty: standard output
  std::string by;                    ///< best: the column whose least value wins; empty: by default
  std::string at_most;               ///< best: "column=bound"; empty: Pareto fronts
  std::optional<int> exit_status{};  ///< set if the program must end at once (--help)

  /// True if nothing but folders is given.
  bool plain() const;
};

/// Parses the command line. Throws InputError.
ResultsOptions parse_results_options(int argc, const char* const* argv);

}  // namespace polhode::study::results
