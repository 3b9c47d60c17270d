// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/narrow_phase/options.hpp"

#include "experiments/study/plan/figure_options.hpp"
#include "experiments/study/text/command_line.hpp"

namespace polhode::study::narrow_phase {

NarrowPhaseOptions parse_narrow_phase_options(const std::string& question, int argc, const char* const* argv) {
  NarrowPhaseOptions options;
  CommandLine line{question, "narrow_phase"};
  line.add("--pairs", options.pairs,
           "answer the pairs of boxes of this file: id, class, then of A and of B half "
           "extents (3), position (3) and quaternion w x y z")
      .type_name("FILE");
  line.add("--narrow-phase", options.narrow_phase, "see --list narrow-phases (default: sat with --pairs, else all)")
      .type_name("NAME");
  line.add("--out", options.out,
           "with --pairs the file of results (default: standard output); else the folder "
           "(default: results/narrow_phase)")
      .type_name("PATH")
      .not_empty();
  line.add("--count", options.count, "pairs of each class in the comparison (default: 2000)")
      .type_name("N")
      .range(std::size_t{1}, std::size_t{10000000});
  line.add("--seed", options.seed, "of the random pairs (default: 1)").type_name("N");
  add_no_figures(line, options.figures);
  add_article(line, options.article);
  add_look_options(line, options.look);
  std::string list;
  const CommandLineOption list_option =
      line.add("--list", list, "print the catalogue, for example narrow-phases (default: all)")
          .type_name("[WHAT]")
          .value_may_be_absent();
  options.exit_status = line.parse(argc, argv);
  if (options.exit_status) return options;
  if (list_option.given()) options.list = list;
  return options;
}

}  // namespace polhode::study::narrow_phase
