// SPDX-License-Identifier: BSD-3-Clause
// What an experiment makes of its finished runs beyond what every study shows. It is the first thing in the report, it
// ends the study on the terminal, and its tables, figures and files stand beside those of the study.
//
// Everything but the timed part must be the same bytes for the same runs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/study/plot/figure.hpp"
#include "experiments/study/plot/table.hpp"

namespace polhode::study::inline record {

inline constexpr const char* timings_folder = "timings";

struct Analysis {
  struct NamedTable {
    std::string name;  ///< file name without extension: tables/NAME.tex and tables/NAME.md
    Table table;
  };
  struct File {
    std::filesystem::path name;  ///< in the folder of results: "orders.csv"
    std::string text;
  };

  /// Its runs are means to another end: the report shows it instead of what every study says and draws of its runs.
  bool alone = false;
  std::string heading{};                 ///< heading of its section of the report: "Observed order"
  std::vector<std::string> sentences{};  ///< findings
  std::vector<std::string> method{};     ///< method by which the numbers were computed; printed below the tables
  std::vector<NamedTable> tables{};      ///< the first one is also printed on the terminal
  std::vector<Figure> figures{};
  std::vector<File> files{};

  /// What was made from wall times, which differ from call to call. It is kept apart in timings/, and the report shows
  /// those figures by reference, so that its own bytes do not depend on them; titles and captions must not either.
  struct Timed {
    std::vector<std::string> sentences{};  ///< findings, printed on the terminal only
    std::vector<Figure> figures{};
    std::vector<File> files{};  ///< paths relative to timings/
  };
  Timed timed{};
};

}  // namespace polhode::study
