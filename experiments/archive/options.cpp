// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/archive/options.hpp"

#include <filesystem>

#include "experiments/study/text/command_line.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::archive {

ArchiveOptions parse_archive_options(int argc, const char* const* argv) {
  ArchiveOptions options;
  CommandLine line{
      "What is there of the trajectories in a folder of results, and what can be saved of those that are not "
      "whole?\n\nThe exit status is 0 if all trajectories are whole (check), or if all that are not are saved as far "
      "as "
      "they go (repair); else 1.",
      "archive"};
  std::string action;
  line.add("action", action,
           "check: say of each trajectory whether it is whole, unfinished or damaged; repair: copy what there is "
           "of those that are not whole into files called trajectory.recovered.csv or trajectory.recovered.h5")
      .type_name("check|repair");
  line.add("folder", options.folder, "a folder of results, with all folders in it").type_name("FOLDER");
  options.exit_status = line.parse(argc, argv);
  if (options.exit_status) return options;
  if (action != "check" && action != "repair") {
    throw InputError((action.empty() ? "no action is named" : "there is no action '" + action + "'") +
                     "; write check or repair, then the folder");
  }
  if (options.folder.empty()) throw InputError("no folder is named; write it after " + action);
  if (!std::filesystem::is_directory(options.folder)) {
    throw InputError(options.folder +
                     (std::filesystem::exists(options.folder) ? " is not a folder" : ": no such folder") +
                     "; name a folder of results");
  }
  options.repair = action == "repair";
  return options;
}

}  // namespace polhode::study::archive
