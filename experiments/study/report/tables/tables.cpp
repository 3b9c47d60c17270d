// SPDX-License-Identifier: BSD-3-Clause
// Folder tables/ of a study: the table of runs in LaTeX and Markdown, and every number as a LaTeX command.
#include "experiments/study/report/tables/tables.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/study/record/shown_runs.hpp"
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

void write_tables_of_runs(const StudyView& study, const std::filesystem::path& folder) {
  const auto rows = rows_of(study);
  const auto table = run_table(study, Extent::summary, rows);
  const std::string part = rows.size() == study.size()
                               ? ""
                               : fmt::format("{} of {} runs, of evenly chosen motions; ", rows.size(), study.size());
  write_text(folder / "summary.tex",
             fmt::format("% {}\n% The preamble needs \\usepackage[T1]{{fontenc}}\\usepackage{{booktabs,longtable}}. "
                         "A dash: not defined for that run.\n% {}runs.csv has all digits and all options.\n{}",
                         title_of(study), part, latex(table)));
  write_text(
      folder / "summary.md",
      fmt::format(
          "# {}\n\n{}\n\nAn empty cell is not defined for that run; {}runs.csv has all digits and all options.\n\n{}",
          markdown(study.experiment), markdown(study.question), part, markdown(table)));
  write_text(folder / "values.tex", tex_values(study, rows));
}

}  // namespace

void write_tables(const StudyView& study) {
  const auto folder = study.folder / "tables";
  std::filesystem::create_directories(folder);
  if (!study.runs.empty()) write_tables_of_runs(study, folder);
  if (!study.analysis) return;
  for (const auto& [name, own] : study.analysis->tables) {
    write_text(
        folder / (name + ".tex"),
        fmt::format("% {}: {}\n% The preamble needs \\usepackage[T1]{{fontenc}}\\usepackage{{booktabs,longtable}}.\n{}",
                    title_of(study), one_line(own.caption), latex(own)));
    write_text(folder / (name + ".md"), fmt::format("# {}\n\n{}\n\n{}", markdown(study.analysis->heading),
                                                    markdown(own.caption), markdown(own)));
  }
  for (const auto& file : study.analysis->files) write_text(study.folder / file.name, file.text);
  if (study.analysis->timed.files.empty()) return;
  std::filesystem::create_directories(study.folder / timings_folder);
  for (const auto& file : study.analysis->timed.files) write_text(study.folder / timings_folder / file.name, file.text);
}

}  // namespace polhode::study::report::tables
