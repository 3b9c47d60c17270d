// SPDX-License-Identifier: BSD-3-Clause
// The command line that all experiments share.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "experiments/study/plan/experiment.hpp"
#include "experiments/study/trajectory/trajectory.hpp"

namespace CLI {
class App;
}

namespace polhode::study::inline plan {

struct Options {
  /// By option name without dashes, as written: {"dt", "1e-3,1e-2"}; defaults filled in.
  std::map<std::string, std::string> axes;
  std::set<std::string> said;                             ///< the axes that the command line or a study file names
  std::vector<std::pair<std::string, std::string>> vary;  ///< key of the scenario and its values, as written
  /// Where a study file sets an axis, or "vary." and a key: "study.toml:3:8: dt".
  std::map<std::string, std::string> places;
  /// How errors name an axis: "--dt", or its place in the study file.
  std::string label(const std::string& axis) const {
    const auto found = places.find(axis);
    return found == places.end() ? "--" + axis : found->second;
  }
  bool plain = false;  ///< no axis is said: everything is as the experiment has it
  std::uint64_t seed = 1;
  std::string out;  ///< empty: results/<experiment>-<scenarios>-<hash>
  bool force = false;
  int jobs = 0;                           ///< 0: one for each core
  std::optional<std::int64_t> max_steps;  ///< of adaptive methods; absent: as Schedule has it
  TrajectoryFormat trajectory = TrajectoryFormat::none;
  bool figures = true;
  bool dry_run = false;
  bool reference = false;
  std::optional<std::string> list;  ///< what to list, "" for everything
  std::string command;              ///< the command line, quoted for a shell
};

/// Either the options, or an exit status where the command line said it all (--help).
struct ParsedOptions {
  Options options;
  std::optional<int> exit_status;
};

/// `more` adds the options of one program alone, or takes away what means nothing to it. Throws InputError.
ParsedOptions parse_options(const Experiment& experiment, int argc, const char* const* argv,
                            const std::function<void(CLI::App&)>& more = {});

/// The axes and other settings of a study file (TOML), as the command line would write them. Throws InputError.
/// Keys: those of the options, without dashes; `vary` is a table from scenario keys to lists.
void read_study_file(const std::string& path, Options& options);

/// Names of all axes, in the order in which they are varied (slowest first).
std::vector<std::string> axis_names();

}  // namespace polhode::study
