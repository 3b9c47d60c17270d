// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/figures/options.hpp"

#include "experiments/study/plan/figure_options.hpp"
#include "experiments/study/text/command_line.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::figures_program {

FiguresOptions parse_figures_options(int argc, const char* const* argv) {
  FiguresOptions options;
  CommandLine line{
      "What do the figures of a stored study look like in another size, or together with another study?\n\nDraws the "
      "figures of stored runs again, from one store or several as one study, and carries out no run. Figures of an "
      "experiment's own analysis are drawn by the command of the study, which carries out no run either.",
      "figures"};
  line.add("folder", options.folders, "folders of results, or folders with such folders in them").type_name("FOLDER…");
  line.add("--where", options.where, "draw runs of which this is true: \"integrator == 'rk4' and dt < 0.01\"")
      .type_name("CONDITION")
      .one_value_each_time()
      .group("Results");
  line.add("--out", options.out, "the figures are written to FOLDER/figures (default: the folder of the study)")
      .type_name("FOLDER")
      .not_empty()
      .group("Results");
  add_figure_options(line, options.choice, true, nullptr);
  options.exit_status = line.parse(argc, argv);
  if (options.exit_status) return options;
  if (options.folders.empty())
    throw InputError(
        "no folder of results is named; write the folder that a study printed, as in figures results/my_study");
  return options;
}

}  // namespace polhode::study::figures_program
