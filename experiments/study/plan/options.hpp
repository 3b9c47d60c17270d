// SPDX-License-Identifier: BSD-3-Clause
// Command line and study file shared by all experiments.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/study/plan/experiment.hpp"
#include "experiments/study/plan/shard.hpp"
#include "experiments/study/plan/study_axes.hpp"
#include "experiments/study/plot/figure_choice.hpp"
#include "experiments/study/text/command_line.hpp"
#include "experiments/study/trajectory/trajectory.hpp"

namespace polhode::study::inline plan {

struct Options {
  std::vector<StudyAxes> studies;  ///< studies, one at least; all are carried out as one list of runs
  std::set<std::string> shared;    ///< options that the command line or the file's defaults give to all studies
  bool plain = false;              ///< no axis is given: all are defaults of the experiment
  std::string study_file;          ///< path of the study file as given; empty: none
  std::string study_file_hash;     ///< text_hash() of its text
  std::uint64_t seed = 1;          ///< seed of random points that have none of their own
  std::string out;                 ///< results folder; empty: results/<experiment>-<scenarios>-<hash>
  bool force = false;
  int jobs = 0;  ///< number of concurrent runs; 0: one for each core
  TrajectoryFormat trajectory = TrajectoryFormat::none;
  std::optional<std::size_t> curves;  ///< largest number of runs whose curves against time are kept; absent: all
  bool figures = true;
  FigureChoice figure_choice{};
  bool article = false;  ///< write the article of the study and its PDF
  bool dry_run = false;
  std::optional<Shard> shard;        ///< the part of the study that is carried out; absent: all of it
  std::optional<std::string> slurm;  ///< value of --slurm; absent: no job scripts
  bool submit = false;               ///< submit the job scripts
  std::vector<std::string> words;    ///< options of the command line that the jobs repeat
  bool merge = false;                ///< join the results of shards; carry out no run
  std::optional<std::string> list;   ///< catalogue to list, "" for all
  std::string command;               ///< the command line, quoted for a shell
};

/// The options, or an exit status if the program must end at once (--help).
struct ParsedOptions {
  Options options;
  std::optional<int> exit_status;
};

/// Parses the command line of an experiment. `more` may add options to those of all experiments, or remove some. Throws
/// InputError.
ParsedOptions parse_options(const Experiment& experiment, int argc, const char* const* argv,
                            const std::function<void(CommandLine&)>& more = {});

/// The content of a study file.
struct StudyFile {
  std::vector<StudyAxes> studies;  ///< studies, with the file's defaults
  std::set<std::string> shared;    ///< options that its defaults give
  std::string curves;              ///< value in the words of --curves; empty: none
  std::string curves_label;        ///< its place: "study.toml:1:10: curves"
  std::string path;                ///< path as given
  std::string hash;                ///< text_hash() of its text
};

/// Reads a study file (TOML); plan/README.md has its language. "FILE:NAME" is one study of the file. `seed`: of random
/// points without a seed. Throws InputError.
StudyFile read_study_file(const std::string& path, std::uint64_t seed);

/// Names of all axes, in the order in which they are varied (slowest first).
std::vector<std::string> axis_names();

}  // namespace polhode::study::plan
