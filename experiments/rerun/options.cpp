// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/rerun/options.hpp"

#include "experiments/study/text/command_line.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::rerun {

RerunOptions parse_rerun_options(int argc, const char* const* argv) {
  RerunOptions options;
  CommandLine line{
      "Does a stored run have the same digits when it is carried out again?\n\nRepeats runs from their store alone and "
      "compares every digit of every metric, and of curves that are kept; wall times aside. The exit status is 0 if "
      "all are the same, 1 if one is different, 3 if one could not be repeated.",
      "rerun"};
  std::vector<std::string> words;
  line.add("words", words,
           "id of the run, or its first digits, and folders of results, or folders with such folders in them "
           "(default: results)")
      .type_name("[ID] FOLDER…");
  line.add("--random", options.random, "repeat so many runs, drawn at random").type_name("N");
  line.add("--seed", options.seed, "seed of that draw (default: 1)").type_name("N");
  bool all = false;
  line.add_flag("--all", all, "repeat all runs");
  line.add("--jobs", options.jobs, "runs at a time (default: one for each core)").type_name("N").range(1, 4096);
  options.exit_status = line.parse(argc, argv);
  if (options.exit_status) return options;
  if (all && options.random) throw InputError("--all and --random: give one of them");
  if (options.random && *options.random == 0) throw InputError("--random: 0 runs show nothing; give a larger number");
  if (!all && !options.random) {
    if (words.empty())
      throw InputError(
          "no run is named; write its id, as `results FOLDER --columns run` prints it, or --random N or --all");
    options.id = words.front();
    words.erase(words.begin());
  }
  options.folders = words.empty() ? std::vector<std::string>{"results"} : words;
  return options;
}

}  // namespace polhode::study::rerun
