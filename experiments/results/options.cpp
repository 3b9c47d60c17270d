// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/results/options.hpp"

#include "experiments/study/text/command_line.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::results {
namespace {

std::vector<std::string> names_of(const std::string& text, const std::string& option) {
  if (text.empty()) return {};
  return split_list(text, ',', option);
}

}  // namespace

bool ResultsOptions::plain() const {
  return where.empty() && columns.empty() && sort.empty() && group.empty() && show.empty() && !limit && !format &&
         out.empty();
}

ResultsOptions parse_results_options(int argc, const char* const* argv) {
  ResultsOptions options;
  CommandLine line{
      "What do the results of studies say? Lists, filters, sorts, groups and exports the runs of folders of "
      "results.\n\nWith folders alone: a summary. `results best FOLDER…`: the least error for a cost, or the least "
      "cost for an error, of all methods. The exit status is 1 if damaged runs were left out.",
      "results"};
  line.add("folder", options.folders, "folders of results, or folders with such folders in them (default: results)")
      .type_name("[best] FOLDER…");
  line.add("--where", options.where, "runs of which this is true: \"integrator == 'rk4' and dt < 0.01\"")
      .type_name("CONDITION")
      .one_value_each_time()
      .group("Runs");
  std::string sort, columns, group, show, format;
  line.add("--sort", sort, "order by these columns; a dash before a name: the largest first")
      .type_name("COLUMN,…")
      .not_empty()
      .group("Runs");
  line.add("--limit", options.limit, "at most so many rows (default: 100 on the terminal, else all)")
      .type_name("N")
      .group("Runs");
  line.add("--group", group, "one row for all runs that have the same values in these columns")
      .type_name("COLUMN,…")
      .not_empty()
      .group("Runs");
  line.add("--columns", columns, "columns to show, or all (default: those that differ; all in CSV)")
      .type_name("COLUMN,…")
      .not_empty()
      .group("Output");
  line.add("--show", show,
           "what to show of each group: count, or min, max, mean, median, sum or count of a column: "
           "median:attitude_error_max_rad,count (default: count)")
      .type_name("[WORD:]COLUMN,…")
      .not_empty()
      .group("Output");
  line.add("--format", format, "table, csv, markdown or latex (default: table; all digits in csv, else five)")
      .type_name("FORMAT")
      .one_of({"table", "csv", "markdown", "latex"})
      .group("Output");
  line.add("--out", options.out, "write this file (default: to the terminal)")
      .type_name("FILE")
      .not_empty()
      .group("Output");
  bool list = false;
  line.add_flag("--list", list, "print the names of all columns").group("Output");
  line.add("--by", options.by,
           "best: the column whose least value wins (default: the error, or the cost if --at-most bounds an error)")
      .type_name("COLUMN")
      .not_empty()
      .group("Best");
  line.add("--at-most", options.at_most,
           "best: runs whose value is not larger, as evaluations=1e5 or attitude_error_max_rad=1e-6 (default: "
           "none, and the runs are shown that no other run of their method beats in both)")
      .type_name("COLUMN=X")
      .not_empty()
      .group("Best");
  options.exit_status = line.parse(argc, argv);
  if (options.exit_status) return options;
  options.list = list;
  if (!options.folders.empty() && options.folders.front() == "best") {
    options.best = true;
    options.folders.erase(options.folders.begin());
  }
  if (options.folders.empty()) options.folders = {"results"};
  options.sort = names_of(sort, "--sort");
  options.columns = names_of(columns, "--columns");
  options.group = names_of(group, "--group");
  options.show = names_of(show, "--show");
  if (!format.empty()) options.format = format_of(format);
  if (options.limit && *options.limit == 0) throw InputError("--limit: 0 rows show nothing; give a larger number");
  if (!options.show.empty() && options.group.empty() && !options.best)
    throw InputError("--show: it says what to show of groups; name their columns with --group");
  if (!options.group.empty() && !options.columns.empty())
    throw InputError("--columns and --group: groups show what --show names; leave --columns out");
  if (!options.best && !(options.by.empty() && options.at_most.empty()))
    throw InputError("--by and --at-most belong to best: results best FOLDER --at-most evaluations=1e5");
  if (options.best && !(options.show.empty() && options.columns.empty() && options.sort.empty()))
    throw InputError("--show, --columns and --sort do not belong to best, which has its own columns and order");
  return options;
}

}  // namespace polhode::study::results
