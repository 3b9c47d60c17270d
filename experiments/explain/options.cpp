// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/explain/options.hpp"

#include <filesystem>
#include <utility>

#include "experiments/study/text/command_line.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::explain {

ExplainOptions parse_explain_options(int argc, const char* const* argv) {
  ExplainOptions options;
  CommandLine line{
      "What makes a stored run the run that it is, and in what do two runs differ?\n\nThe id of a run is a hash of the "
      "results version, of the scenario with its varied keys set, and of each option. With one id: all of these. With "
      "two: the keys that differ.",
      "explain"};
  std::vector<std::string> words;
  line.add("words", words,
           "one or two ids of runs, or their first digits, and folders of results, or folders with such folders "
           "in them (default: results)")
      .type_name("ID [ID] FOLDER…");
  options.exit_status = line.parse(argc, argv);
  if (options.exit_status) return options;
  for (std::string& word : words) {
    std::error_code none;
    const bool digits = word.size() <= 16 && word.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (options.folders.empty() && digits && !std::filesystem::exists(word, none))
      options.ids.push_back(std::move(word));
    else options.folders.push_back(std::move(word));
  }
  if (options.ids.empty()) {
    throw InputError(
        "no run is named; write the ids of one or two runs, as `results FOLDER --columns run` prints them, "
        "then the folders");
  }
  if (options.ids.size() > 2) throw InputError("explain compares two runs, and these are more; name one or two");
  if (options.folders.empty()) options.folders = {"results"};
  return options;
}

}  // namespace polhode::study::explain
