// SPDX-License-Identifier: BSD-3-Clause
// Command line of `rerun`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace polhode::study::rerun {

struct RerunOptions {
  std::string id;                       ///< id of one run; empty: several runs
  std::optional<std::size_t> random{};  ///< number of runs to draw; absent without an id: all
  std::uint64_t seed = 1;
  int jobs = 0;                      ///< runs at a time; 0: one for each core
  std::vector<std::string> folders;  ///< folders of results, one at least
  std::optional<int> exit_status{};  ///< set if the program must end at once (--help)
};

/// Parses the command line. Throws InputError.
RerunOptions parse_rerun_options(int argc, const char* const* argv);

}  // namespace polhode::study::rerun
