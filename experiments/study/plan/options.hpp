// SPDX-License-Identifier: BSD-3-Clause
// Command line and study file shared by all experiments.
#pragma once

#include <cstddef>
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
  /// Values of the axes as written, by option name without dashes: {"dt", "1e-3,1e-2"}. Includes defaults.
  std::map<std::string, std::string> axes;
  std::set<std::string> said;                             ///< axes given on the command line or in a study file
  std::vector<std::pair<std::string, std::string>> vary;  ///< keys of the scenario and their values, as written
  /// Places of settings in the study file, by axis, or by "vary." and a key: "study.toml:3:8: dt".
  std::map<std::string, std::string> places;
  /// Name of an axis in error messages: "--dt", or its place in the study file.
  std::string label(const std::string& axis) const {
    const auto found = places.find(axis);
    return found == places.end() ? "--" + axis : found->second;
  }
  bool plain = false;           ///< no axis is given: all are defaults of the experiment
  std::string study_file;       ///< path of the study file as given; empty: none
  std::string study_file_hash;  ///< text_hash() of its text
  std::uint64_t seed = 1;
  std::string out;  ///< empty: results/<experiment>-<scenarios>-<hash>
  bool force = false;
  int jobs = 0;                           ///< number of concurrent runs; 0: one for each core
  std::optional<std::int64_t> max_steps;  ///< largest number of steps of adaptive methods; absent: that of Schedule
  TrajectoryFormat trajectory = TrajectoryFormat::none;
  std::optional<std::size_t> curves;  ///< largest number of runs whose curves against time are kept; absent: all
  bool figures = true;
  bool dry_run = false;
  bool reference = false;
  std::optional<std::string> list;  ///< catalogue to list, "" for all
  std::string command;              ///< the command line, quoted for a shell
};

/// The options, or an exit status if the program must end at once (--help).
struct ParsedOptions {
  Options options;
  std::optional<int> exit_status;
};

/// Parses the command line of an experiment. `more` may add options to those of all experiments, or remove some. Throws
/// InputError.
ParsedOptions parse_options(const Experiment& experiment, int argc, const char* const* argv,
                            const std::function<void(CLI::App&)>& more = {});

/// Reads the axes and other settings of a study file (TOML) into the options, in the syntax of the command line. Keys:
/// option names without leading dashes; `reference`: true or false; `vary`: a table from scenario keys to lists. Throws
/// InputError.
void read_study_file(const std::string& path, Options& options);

/// Names of all axes, in the order in which they are varied (slowest first).
std::vector<std::string> axis_names();

}  // namespace polhode::study::plan
