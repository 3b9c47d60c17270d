// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/narrow_phase/options.hpp"

#include <CLI/CLI.hpp>

#include "experiments/study/plan/figure_options.hpp"
#include "experiments/study/text/command_line.hpp"

namespace polhode::study::narrow_phase {

NarrowPhaseOptions parse_narrow_phase_options(const std::string& question, int argc, const char* const* argv) {
  NarrowPhaseOptions options;
  CLI::App app{question, "narrow_phase"};
  app.get_formatter()->column_width(40);
  app.add_option("--pairs", options.pairs,
                 "answer the pairs of boxes of this file: id, class, then of A and of B half "
                 "extents (3), position (3) and quaternion w x y z")
      ->type_name("FILE");
  app.add_option("--narrow-phase", options.narrow_phase,
                 "see --list narrow-phases (default: sat with --pairs, else all)")
      ->type_name("NAME");
  app.add_option("--out", options.out,
                 "with --pairs the file of results (default: standard output); else the folder "
                 "(default: results/narrow_phase)")
      ->type_name("PATH");
  app.add_option("--count", options.count, "pairs of each class in the comparison (default: 2000)")
      ->type_name("N")
      ->check(CLI::Range(std::size_t{1}, std::size_t{10000000}).description(""));
  app.add_option("--seed", options.seed, "of the random pairs (default: 1)")->type_name("N");
  add_no_figures(app, options.figures);
  add_article(app, options.article);
  add_look_options(app, options.look);
  std::string list;
  CLI::Option* list_option =
      app.add_option("--list", list, "print the catalogue, for example narrow-phases (default: all)")
          ->type_name("[WHAT]")
          ->expected(0, 1);
  options.exit_status = parse_command_line(app, argc, argv);
  if (options.exit_status) return options;
  if (*list_option) options.list = list;
  return options;
}

}  // namespace polhode::study::narrow_phase
