// SPDX-License-Identifier: BSD-3-Clause
// Do the narrow phases agree, what do they cost, and how often does the course report's test err?
#include <fmt/format.h>

#include <filesystem>

#include "experiments/narrow_phase/comparison.hpp"
#include "experiments/narrow_phase/options.hpp"
#include "experiments/narrow_phase/pairs.hpp"
#include "experiments/study/plan/listing.hpp"
#include "experiments/study/record/study_view.hpp"
#include "experiments/study/report/article/article.hpp"
#include "experiments/study/report/figures/study_figures.hpp"
#include "experiments/study/report/page/report.hpp"
#include "experiments/study/report/tables/summary.hpp"
#include "experiments/study/report/tables/tables.hpp"
#include "experiments/study/text/command_line.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/program.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/text_file.hpp"

namespace polhode::study::narrow_phase {
namespace {

const NarrowPhaseEntry& entry(const std::string& name) {
  if (const NarrowPhaseEntry* found = find_narrow_phase(name)) return *found;
  std::vector<std::string_view> known;
  for (const NarrowPhaseEntry& e : narrow_phase_catalogue()) known.emplace_back(e.name);
  throw InputError("--narrow-phase: no narrow phase '" + name + "'" + suggestion(name, "There are", known));
}

void answer_pairs(const NarrowPhaseOptions& options) {
  const auto narrow_phase = entry(options.narrow_phase.empty() ? "sat" : options.narrow_phase).make();
  const std::string text = answers(read_pairs(options.pairs), *narrow_phase);
  if (options.out.empty()) {
    fmt::print("{}", text);
  } else {
    write_text(options.out, text);
  }
}

void compare(const NarrowPhaseOptions& options, const std::string& question, const std::string& command) {
  std::vector<const NarrowPhaseEntry*> entries;
  for (const NarrowPhaseEntry& e : narrow_phase_catalogue()) entries.push_back(&e);
  if (!options.narrow_phase.empty()) entries = {&entry(options.narrow_phase)};
  StudyView view;
  view.experiment = "narrow_phase";
  view.question = question;
  view.command = command;
  view.folder = options.out.empty() ? "results/narrow_phase" : options.out;
  Analysis analysis{.alone = true, .heading = "Narrow phases side by side"};
  compare_narrow_phases(entries, options.count, options.seed, analysis);
  measure_course_report(10 * options.count, options.seed, analysis);
  view.figure_choice.look = options.look;
  choose_figures(view.figure_choice, analysis.figures);
  choose_figures(view.figure_choice, analysis.timed.figures);
  view.analysis = std::move(analysis);
  std::filesystem::create_directories(view.folder);
  write_tables(view);
  if (options.figures) {
    const std::string skipped = write_figures(view);
    if (!skipped.empty()) fmt::print(stderr, "narrow_phase: {}\n", skipped);
  }
  write_report(view);
  if (options.article) {
    const std::string skipped = write_article(view);
    if (!skipped.empty()) fmt::print(stderr, "narrow_phase: {}\n", skipped);
  }
  fmt::print("{}\n{}\n", summary_table(view), (view.folder / "report.html").string());
}

int run_narrow_phase(int argc, char** argv) {
  const std::string question =
      "Do the narrow phases agree, what do they cost, and how often does the course report's test err?";
  const auto options = parse_narrow_phase_options(question, argc, argv);
  if (options.exit_status) return *options.exit_status;
  if (options.list) {
    fmt::print("{}", listing(*options.list));
    return 0;
  }
  if (options.pairs.empty()) {
    compare(options, question, command_text("narrow_phase", argc, argv));
  } else {
    answer_pairs(options);
  }
  return 0;
}

}  // namespace
}  // namespace polhode::study::narrow_phase

int main(int argc, char** argv) {
  using namespace polhode::study;
  using namespace polhode::study::narrow_phase;
  return run_program("narrow_phase", [&] { return run_narrow_phase(argc, argv); });
}
