// SPDX-License-Identifier: BSD-3-Clause
// Folder tables/ of a study: the tables of runs and of methods in LaTeX, Markdown and CSV, and every number as a LaTeX
// command.
#include "experiments/study/report/tables/tables.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/latex_table.hpp"
#include "experiments/study/record/shown_runs.hpp"
#include "experiments/study/report/findings/method_table.hpp"
#include "experiments/study/report/tables/run_table.hpp"
#include "experiments/study/report/tables/tex_values.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/text_file.hpp"

namespace polhode::study::inline report::inline tables {

namespace {

std::string title_of(const StudyView& study) {
  return one_line(fmt::format("{}: {}", study.experiment, study.question));
}

/// Indices of the runs with a row in the tables.
std::vector<std::size_t> rows_of(const StudyView& study) {
  const std::size_t runs = study.runs.size();
  if (runs <= most_table_rows) return evenly_spread(runs, runs);
  std::vector<std::uint64_t> motions;
  for (const RunRecord& run : study.runs) motions.push_back(number_of(*run.scenario));
  return shown_runs(motions, rows_of_large_tables);
}

void write_table(const StudyView& study, const std::filesystem::path& folder, const std::string& name,
                 const std::string& heading, const Table& table) {
  const std::string best = words_for_best(table);
  const std::string caption = table.caption + (best.empty() ? "" : ". " + best);
  write_text(folder / (name + ".tex"),
             fmt::format("% {}\n% {}\n% The preamble needs {}\n{}", title_of(study), one_line(caption),
                         packages_of_latex_tables, latex_table(table).text));
  write_text(folder / (name + ".md"),
             fmt::format("# {}\n\n{}\n\n{}", markdown(heading), markdown(caption), markdown(table)));
  write_text(folder / (name + ".csv"), csv(table));
}

void write_tables_of_runs(const StudyView& study, const std::filesystem::path& folder) {
  const auto rows = rows_of(study);
  const std::string part = rows.size() == study.size()
                               ? ""
                               : fmt::format("{} of {} runs, of evenly chosen motions", rows.size(), study.size());
  Table runs = run_table(study, Extent::summary, rows);
  runs.caption = fmt::format("The runs{}. A dash: not defined for that run; runs.csv has all digits and all options",
                             part.empty() ? "" : ": " + part);
  write_table(study, folder, "summary", study.experiment, runs);
  Table methods = method_table(group(study));
  methods.caption = "Method by method. " + methods.caption;
  write_table(study, folder, "methods", study.experiment, methods);
  write_tex_values(study, rows, folder);
}

}  // namespace

void write_tables(const StudyView& study) {
  const auto folder = study.folder / "tables";
  std::filesystem::create_directories(folder);
  if (!study.runs.empty()) write_tables_of_runs(study, folder);
  if (!study.analysis) return;
  for (const auto& [name, own] : study.analysis->tables) write_table(study, folder, name, study.analysis->heading, own);
  for (const auto& file : study.analysis->files) write_text(study.folder / file.name, file.text);
  if (study.analysis->timed.files.empty()) return;
  std::filesystem::create_directories(study.folder / timings_folder);
  for (const auto& file : study.analysis->timed.files) write_text(study.folder / timings_folder / file.name, file.text);
}

}  // namespace polhode::study::report::tables
