// SPDX-License-Identifier: BSD-3-Clause
// A table in LaTeX that fits the line of an article of 11 pt on A4: letters of 9 or 8 pt, texts in several lines, and
// where its columns are still too many, several tables below each other that repeat the columns that tell the rows
// apart. Higher than a page: longtables.
#pragma once

#include <string>

#include "experiments/study/plot/table.hpp"

namespace polhode::study::inline plot {

struct LatexTable {
  std::string text;         ///< needs the packages booktabs, longtable and array
  bool over_pages = false;  ///< longtables, which may not stand in a float
};
/// The table in LaTeX, with the best cells of a column in bold.
LatexTable latex_table(const Table& table);

/// Packages that latex_table() needs: "\usepackage{…}".
inline constexpr const char* packages_of_latex_tables =
    "\\usepackage[utf8]{inputenc}\\usepackage[T1]{fontenc}\\usepackage{textcomp,lmodern,array,booktabs,longtable}";

/// Text in LaTeX in which a line may break after the signs within names and numbers: "spinning\_\allowbreak{}cubes".
std::string tex_breakable(std::string_view utf8);

}  // namespace polhode::study::plot
