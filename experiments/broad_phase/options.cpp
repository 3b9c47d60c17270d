// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/broad_phase/options.hpp"

#include <cmath>

#include "experiments/study/plan/figure_options.hpp"
#include "experiments/study/text/command_line.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::broad_phase {
namespace {

std::vector<const BroadPhaseEntry*> phases_of(const std::string& text) {
  std::vector<const BroadPhaseEntry*> phases;
  std::vector<std::string_view> known;
  for (const BroadPhaseEntry& e : broad_phase_catalogue()) known.emplace_back(e.name);
  for (const std::string& name : split_list(text, ',', "--broad-phase")) {
    if (name == "all") {
      for (const BroadPhaseEntry& e : broad_phase_catalogue()) phases.push_back(&e);
      continue;
    }
    const BroadPhaseEntry* found = find_broad_phase(name);
    if (!found) {
      throw InputError("--broad-phase: no broad phase '" + name + "'" + suggestion(name, "There are", known));
    }
    phases.push_back(found);
  }
  for (std::size_t i = 0; i < phases.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (phases[i] == phases[j]) throw InputError("--broad-phase: " + phases[i]->name + " is named twice");
    }
  }
  return phases;
}

std::vector<std::size_t> counts_of(const std::string& text) {
  std::vector<std::size_t> counts;
  for (const double x : numbers(text, "--bodies")) {
    const double n = std::round(x);
    if (!(n >= 1 && n <= 1e8)) throw InputError("--bodies: " + exact(x) + " bodies; take 1 to 1e8");
    if (counts.empty() || counts.back() != static_cast<std::size_t>(n)) counts.push_back(static_cast<std::size_t>(n));
  }
  return counts;
}

void require(bool good, const std::string& what) {
  if (!good) throw InputError(what);
}

}  // namespace

BroadPhaseOptions parse_broad_phase_options(int argc, const char* const* argv) {
  BroadPhaseOptions options;
  CommandLine line{
      std::string(broad_phase_question) +
          "\n\nWithout --boxes: measures boxes that move about at a fixed density. With --boxes: answers recorded "
          "motion.",
      "broad_phase", 32};
  std::string phases, bodies = "100:100000:7:log", list;
  line.add("--broad-phase", phases, "broad phases, or all (default; with --boxes one must be named)")
      .type_name("NAME,…");
  const CommandLineOption boxes =
      line.add("--boxes", options.boxes, "recorded motion: CSV with the columns step, id, hx, hy, hz, px, py, pz")
          .type_name("FILE");
  line.add("--out", options.out,
           "with --boxes the file of pairs: step, a, b; otherwise the folder of results (default: "
           "results/broad_phase)")
      .type_name("PATH")
      .not_empty();
  const std::vector<CommandLineOption> measuring = {
      line.add("--bodies", bodies, "how many boxes (default: " + bodies + ")").type_name("N,…"),
      line.add("--filling", options.filling, "part of the space that is within boxes (default: 0.1)").type_name("X"),
      line.add("--motion", options.motion, "mean path of a box in a step, over the mean edge (default: 0.02)")
          .type_name("X"),
      line.add("--patience", options.patience,
               "leave out what is expected to take longer for a step, in s (default: 0.5)")
          .type_name("S"),
      line.add("--seed", options.seed, "of the random boxes (default: 1)").type_name("N"),
      add_no_figures(line, options.figures),
      add_article(line, options.article)};
  add_look_options(line, options.look);
  const CommandLineOption list_option =
      line.add("--list", list, "print the catalogue: broad-phases, or what else the experiments list")
          .type_name("[WHAT]")
          .value_may_be_absent();
  options.exit_status = line.parse(argc, argv);
  if (options.exit_status) return options;
  options.command = command_text("broad_phase", argc, argv);
  if (list_option.given()) options.list = list;
  if (options.list) return options;
  if (boxes.given()) {
    for (const CommandLineOption& option : measuring) {
      require(!option.given(), option.name() + " has no meaning with --boxes; leave it out");
    }
    require(!options.boxes.empty(), "--boxes: no file is named");
    require(!phases.empty(), "--broad-phase is missing: it says which one answers --boxes; see --list broad-phases");
    require(!options.out.empty(), "--out is missing: it names the file for the pairs");
  }
  options.phases = phases_of(phases.empty() ? "all" : phases);
  if (boxes.given()) require(options.phases.size() == 1, "--broad-phase: with --boxes it takes one name");
  options.bodies = counts_of(bodies);
  require(options.filling > 0 && options.filling <= 100, "--filling: take a number above 0, 100 at most");
  require(options.motion >= 0 && std::isfinite(options.motion), "--motion: take 0 or a finite number above");
  require(options.patience > 0, "--patience: take a number above 0");
  return options;
}

}  // namespace polhode::study::broad_phase
