// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/options.hpp"

#include <algorithm>

#include "experiments/study/plan/figure_options.hpp"
#include "experiments/study/text/command_line.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::judge {
JudgeOptions parse_judge_options(int argc, const char* const* argv) {
  JudgeOptions options;
  CommandLine line{
      std::string(judge_question) +
          "\n\nTrajectories are CSV files with the columns of trajectory.csv (experiments/judge/README.md), by "
          "name and in any order.",
      "judge"};
  std::vector<std::string> lists;
  line.add("--scenario", options.scenario, "what the trajectories are of: a built-in scenario or a TOML file")
      .type_name("NAME|FILE");
  line.add("--trajectory-file", lists, "trajectories, with commas between them").type_name("FILE,…");
  line.add("files", options.files, "the same, one by one").type_name("FILE");
  line.add_flag(
      "--reference", options.reference,
      "where no exact solution is known, measure errors against a motion in extended precision that proves its "
      "digits by halving its step");
  std::string rotation = "normalized";
  line.add("--rotation-from", rotation, "what a quaternion off the unit sphere stands for (default: normalized)")
      .type_name("normalized|stored")
      .one_of({"normalized", "stored"});
  line.add("--out", options.out, "folder of the results (default: results/judge-<scenario>-<hash>)")
      .type_name("FOLDER")
      .not_empty();
  line.add_flag("--force", options.force, "overwrite other results in that folder");
  add_no_figures(line, options.figures);
  add_look_options(line, options.look);
  options.exit_status = line.parse(argc, argv);
  if (options.exit_status) return options;
  options.rotation_from = rotation == "stored" ? RotationFrom::stored : RotationFrom::normalized;
  for (const std::string& list : lists) {
    for (const std::string& file : split_list(list, ',', "--trajectory-file")) options.files.push_back(file);
  }
  if (options.scenario.empty()) throw InputError("--scenario is missing: it says what the trajectories are of");
  if (options.files.empty()) throw InputError("no trajectory is named; give one or more CSV files");
  for (std::size_t i = 0; i < options.files.size(); ++i) {
    if (std::find(options.files.begin(), options.files.begin() + static_cast<std::ptrdiff_t>(i), options.files[i]) !=
        options.files.begin() + static_cast<std::ptrdiff_t>(i)) {
      throw InputError(options.files[i] + " is named twice; leave one out");
    }
  }
  options.command = command_text("judge", argc, argv);
  return options;
}

}  // namespace polhode::study::judge
