// SPDX-License-Identifier: BSD-3-Clause
// Analysis: the results that an experiment derives from its finished runs, beyond those of every study. It comes first
// in the report and last on the terminal; its tables, figures and files are written beside those of the study.
//
// Must be deterministic, except for the timed part: the same runs must yield the same bytes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/plot/figure.hpp"
#include "experiments/study/plot/table.hpp"

namespace polhode::study::inline record {

inline constexpr const char* timings_folder = "timings";

/// The answer to the question of a study, with which its report begins.
struct Answer {
  std::vector<std::string> sentences{};  ///< sentences of the answer, three at most
  std::vector<std::string> depends{};    ///< circumstances on which the answer depends
  std::optional<Table> table{};          ///< a few rows
};

struct Analysis {
  struct NamedTable {
    std::string name;  ///< file name without extension: tables/NAME.tex and tables/NAME.md
    Table table;
  };
  struct File {
    std::filesystem::path name;  ///< path relative to the results folder: "orders.csv"
    std::string text;
  };

  /// True: the report shows the analysis in place of the usual findings and figures of the runs.
  bool alone = false;
  Answer answer{};        ///< the first figure stands beside it; without sentences: those below are the answer
  std::string heading{};  ///< heading of its section of the report: "Observed order"
  std::vector<std::string> sentences{};  ///< findings
  std::vector<std::string> method{};     ///< method by which the numbers were computed; printed below the tables
  std::vector<NamedTable> tables{};      ///< the first one is also printed on the terminal
  std::vector<Figure> figures{};
  std::vector<File> files{};

  /// Results derived from wall times, which differ from call to call. They are stored apart in timings/. The report
  /// includes these figures by reference, so that its bytes do not depend on wall times; titles and captions of the
  /// figures must not depend on them either.
  struct Timed {
    std::vector<std::string> sentences{};  ///< findings, printed on the terminal only
    std::vector<Figure> figures{};
    std::vector<File> files{};  ///< paths relative to timings/
  };
  Timed timed{};
};

}  // namespace polhode::study::record
