// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/plot/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "experiments/study/plan/figure_options.hpp"
#include "experiments/study/text/command_line.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::plot_program {
namespace {

/// True if the word can be ids of runs with commas between them, and is no folder.
bool are_ids(const std::string& word) {
  return !std::filesystem::exists(word) && !word.empty() &&
         word.find_first_not_of("0123456789abcdef,") == std::string::npos;
}

}  // namespace

PlotOptions parse_plot_options(int argc, const char* const* argv) {
  PlotOptions options;
  CommandLine line{
      fmt::format(
          "How do the quantities of stored runs evolve, and what path does ω trace?\n\nCarries out runs of a store "
          "again, at most {}, and draws quantities of their motion: against time, against each other, or in "
          "space. Every state that the run measures is looked at.",
          most_runs),
      "plot"};
  std::vector<std::string> words;
  line.add("words", words,
           "ids of runs, or their first digits, as `results FOLDER --columns run,integrator,dt` prints them "
           "(default: all that satisfy --where), and folders of results")
      .type_name("[RUN,…] FOLDER…");
  std::string quantities = "energy,omega";
  line.add("--quantity", quantities, "what is drawn, of --list (default: energy,omega)").type_name("NAME,…");
  line.add("--where", options.where, "runs of which this is true: \"integrator == 'rk4' and dt < 0.01\"")
      .type_name("CONDITION")
      .one_value_each_time();
  line.add("--body", options.body,
           "of which omega, position and other quantities of one body are (default: the "
           "first that moves)")
      .type_name("NAME");
  line.add("--out", options.out, "the figures are written to FOLDER/plots (default: the folder of the study)")
      .type_name("FOLDER")
      .not_empty();
  line.add_flag("--list", options.list, "print the quantities");
  add_look_options(line, options.look);
  options.exit_status = line.parse(argc, argv);
  if (options.exit_status || options.list) return options;
  for (const std::string& name : split_list(quantities, ',', "--quantity")) {
    const PlotQuantity* quantity = &quantity_named(name);
    if (std::find(options.quantities.begin(), options.quantities.end(), quantity) == options.quantities.end())
      options.quantities.push_back(quantity);
  }
  if (!words.empty() && are_ids(words.front())) {
    options.ids = split_list(words.front(), ',', "the runs");
    words.erase(words.begin());
  }
  options.folders = std::move(words);
  if (options.folders.empty())
    throw InputError(
        "no folder of results is named; write the folder that a study printed, as in plot results/my_study");
  if (!options.ids.empty() && !options.where.empty())
    throw InputError("--where and runs by their ids: give one of them");
  if (options.ids.size() > most_runs)
    throw InputError(fmt::format("{} runs are named; a figure shows at most {}", options.ids.size(), most_runs));
  return options;
}

}  // namespace polhode::study::plot_program
