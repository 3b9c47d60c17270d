// SPDX-License-Identifier: BSD-3-Clause
// The table of metrics: one entry for each measured result of a run. The store, runs.csv, the tables of runs, the
// summary on the terminal, the LaTeX values, `--list metrics` and judge loop over this table.
//
// To add a metric: add an entry in metric_table.cpp, and the code that measures it. That code writes the number into
// RunResult::further under the name of the column, unless the entry names a member of RunResult.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "experiments/study/record/run_record.hpp"
#include "experiments/study/text/csv.hpp"

namespace polhode::study::inline record {

struct Metric {
  /// Place of the value in a result. std::monostate: RunResult::further, under the name of the column. A map: one
  /// number for each declared invariant.
  using Member =
      std::variant<std::monostate, std::optional<double> RunResult::*, std::optional<double> ContactMeasures::*,
                   std::optional<double> JointMeasures::*, std::int64_t RunResult::*, std::string RunResult::*,
                   std::map<std::string, double> RunResult::*>;

  /// The runs for which the metric is defined. runs.csv has its column only in a study with such runs.
  enum class Runs { all, with_reference, with_contact, with_joints };

  /// Name in runs.csv and in the store: an identifier that ends with the unit. A metric for each invariant has the
  /// columns INVARIANT_drift_max_rel in runs.csv.
  std::string column;
  Member member{};
  Runs runs = Runs::all;
  bool may_be_infinite = false;  ///< infinite values are kept; requires a member
  /// All texts that a finished run can have as its value, for a member that is a text; empty: any text.
  std::vector<std::string_view> words{};

  /// Text of its line in `--list metrics`. A line break in it begins a further line. Empty if the line of another
  /// metric describes this one too.
  std::string meaning{};
  std::string listed_as{};    ///< name in that list, for a family of columns; empty: the column
  std::string listed_with{};  ///< column of the metric whose line describes this one too; empty: it has its own line
  int list_rank = 0;  ///< position in that list: smaller ranks first, equal ranks in the order of the metric table

  /// Heading of its column in the tables of runs; empty: no column.
  std::string label{};
  std::string unit{};                               ///< unit in those tables
  bool least_is_best = false;                       ///< an error or a drift: tables mark its least value
  bool in_summary = false;                          ///< also in the narrow table (tables/summary.md and .tex)
  std::string (*cell)(const RunResult&) = nullptr;  ///< text of the table's cell; null: the number
  int table_rank = 5;                               ///< rank as list_rank, for the tables of runs and the LaTeX values

  // The column of the summary on the terminal, in the order of the tables of runs.
  std::string terminal_label{};                              ///< heading of its column; empty: no column
  std::string (*terminal_cell)(const RunResult&) = nullptr;  ///< text of its cell; null: the value, "-" if absent

  std::string tex{};  ///< last part of the name of the LaTeX command (tex_values.hpp); empty: no command

  bool in_scores = true;      ///< judge measures it for a trajectory of unknown origin and writes it to scores.csv
  std::string judge_label{};  ///< heading in judge's table; empty: no column there
};

/// The kinds of runs that a study has.
struct RunKinds {
  bool reference = false, contact = false, joints = false;
  /// True if some run has a metric of these runs.
  bool define(Metric::Runs runs) const {
    switch (runs) {
      case Metric::Runs::with_reference: return reference;
      case Metric::Runs::with_contact: return contact;
      case Metric::Runs::with_joints: return joints;
      default: return true;
    }
  }
};

/// All metrics, in the order of the columns of runs.csv.
const std::vector<Metric>& metric_table();

/// The metric with this column. Throws std::logic_error if there is none.
const Metric& metric_of_column(const std::string& column);

/// The metrics in the order of the tables of runs.
std::vector<const Metric*> in_table_order(std::span<const Metric> metrics);

/// with_value() for a metric whose member is known to be `member`.
template <class Member, class Result, class Use>
void with_value_of(Member member, const Metric& metric, Result& result, const Use& use) {
  if constexpr (std::is_same_v<Member, std::monostate>) {
    const auto found = result.further.find(metric.column);
    std::optional<double> value;
    if (found != result.further.end()) value = found->second;
    use(value);
    if constexpr (!std::is_const_v<Result>) {
      if (value) result.further[metric.column] = *value;
      else result.further.erase(metric.column);
    }
  } else if constexpr (std::is_same_v<Member, std::optional<double> ContactMeasures::*>) {
    use(result.contact.*member);
  } else if constexpr (std::is_same_v<Member, std::optional<double> JointMeasures::*>) {
    use(result.joints.*member);
  } else {
    use(result.*member);
  }
}

/// Calls use(value) with a reference to the metric's value in the result: a std::optional<double>, std::int64_t,
/// std::string or std::map<std::string, double>. If the result is not const, the value may be changed.
template <class Result, class Use>
void with_value(const Metric& metric, Result& result, const Use& use) {
  std::visit([&](auto member) { with_value_of(member, metric, result, use); }, metric.member);
}

/// Columns of the metric in runs.csv: one, or one for each of the invariants.
std::vector<std::string> csv_columns(const Metric& metric, const std::vector<std::string>& invariants);

/// Adds the cells below csv_columns(), with all digits; empty if the number is absent or not finite.
void add_csv_cells(CsvRow& row, const Metric& metric, const RunResult& result,
                   const std::vector<std::string>& invariants);

/// The cell of the tables of runs: the number in the format of number(). Empty if the number is absent or not finite,
/// for a count of 0, and for a metric with one number per invariant.
std::string table_cell(const Metric& metric, const RunResult& result);

/// True if table_cell() is a text rather than a number.
bool is_text(const Metric& metric);

}  // namespace polhode::study::record
