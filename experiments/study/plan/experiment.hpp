// SPDX-License-Identifier: BSD-3-Clause
// Definition of an experiment: its question, its default runs and its analysis.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "experiments/study/record/shown_runs.hpp"
#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline plan {

/// A further product of axes, given by its differences from the defaults of the first product. Options of the user
/// override the defaults of all products.
struct FurtherAxes {
  std::map<std::string, std::string> defaults{};
  std::vector<std::pair<std::string, std::string>> vary{};  ///< keys of the scenario and their values
  bool reference = false;        ///< motions without contact have a reference, as with --reference
  bool by_default_only = false;  ///< omitted if the user gives any axis
};

/// The wall time of a run if the experiment requires best times: a short run is repeated and the least time kept, since
/// disturbances by other programs only increase it.
struct BestTime {
  static constexpr double repeated_below = 0.04;  ///< s
  static constexpr int repetitions = 5;
};

struct Experiment {
  std::string name;
  std::string question;   ///< one sentence
  std::string meaning{};  ///< meaning of the answer in one paragraph, for --help; empty: none
  /// Defaults of options, in the syntax of the command line: {"dt", "1e-3,1e-2"}.
  std::map<std::string, std::string> defaults;
  /// Defaults in place of those if no scenario is named and each named method solves the equations of joints itself.
  FurtherAxes with_joints{};
  /// Defaults of --vary: keys of the scenario and their values. Used only if the user gives neither a scenario nor a
  /// study file; --vary replaces a default for the same key.
  std::vector<std::pair<std::string, std::string>> vary{};
  bool reference = false;             ///< motions without contact have a reference, as with --reference
  std::vector<FurtherAxes> more{};    ///< further products of axes
  bool one_run = false;               ///< exactly one run, whose trajectory is written to the results folder itself
  bool best_times = false;            ///< wall times are taken as BestTime says
  bool fixed_steps_only = false;      ///< adaptive methods are not allowed
  bool failures_are_results = false;  ///< failed runs are results and do not change the exit status
  bool curves_are_results = false;    ///< the analysis uses the curves against time of all runs
  /// Duration of a run, s, from the requested duration (s) and the step (s), or the tolerance of an adaptive method.
  /// Empty: the requested duration.
  std::function<double(double t_end, double dt)> duration{};
  /// Returns further runs to carry out, given all finished runs. It is called again with their results until it returns
  /// no new run. Must be deterministic: the same finished runs must yield the same requests, so that an interrupted
  /// study can be continued.
  std::function<std::vector<RunConfig>(const StudyView&)> refine{};
  bool analysis_alone = false;  ///< the analysis replaces the figures of every study (Analysis::alone)
  /// Analysis of the finished runs beyond that of every study; empty: none.
  std::function<Analysis(const StudyView&)> analysis{};
  /// The measured needs of the default study besides its first runs, for the time that --dry-run prints.
  struct Needs {
    double refined = 0;       ///< processor time of the runs that `refine` requests, over that of the others
    double analysis = 0;      ///< processor time of the analysis, on all threads, over that of all runs
    std::size_t figures = 0;  ///< number of figures that the analysis makes
  };
  Needs needs{};
};

/// True if all runs of a study are held when its files are written; else a few at a time are.
inline bool is_held(const Experiment& experiment, std::size_t runs) {
  return runs <= most_table_rows || experiment.analysis || experiment.refine;
}

}  // namespace polhode::study::plan
