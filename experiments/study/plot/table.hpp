// SPDX-License-Identifier: BSD-3-Clause
// A table of texts, printed as HTML, Markdown or CSV; latex_table.hpp prints it in LaTeX.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace polhode::study::inline plot {

struct Column {
  enum class Kind { name, number, text };
  enum class Best { none, least, greatest };
  std::string header;
  std::string unit{};  ///< printed behind the header; empty: none
  Kind kind = Kind::number;
  Best best = Best::none;  ///< the value that is marked
  bool apart = false;      ///< values of other columns are compared only between rows with the same cell here
  bool key = false;        ///< tells the rows apart, beside the columns before the first number
};

struct Table {
  std::string caption;
  std::vector<Column> columns;
  std::vector<std::vector<std::string>>
      rows;  ///< numbers as printed by number() and exact_number(); empty: not defined
};

/// The table without columns whose cells are all empty.
Table without_empty_columns(Table table);

enum class Caption {
  shown,
  spoken  ///< a caption for screen readers only, if the page shows it elsewhere
};
/// A cell with " ≈ " names two that tie; it is grey.
std::string html(const Table& table, Caption caption = Caption::shown);

/// True for the cells, by row and column, with the best value of their column, as printed. Of equal ones each is
/// marked; none is where all are equal. "≥ 60" and "none to 60" count as 60.
std::vector<std::vector<bool>> best_cells(const Table& table);
/// The caption's words for the marks; empty if no cell is marked.
std::string words_for_best(const Table& table);

std::string markdown(const Table& table);  ///< the best cells are bold
/// The cells as they are printed, and the column `best` with the headers of those columns in which the row is best.
std::string csv(const Table& table);

}  // namespace polhode::study::plot
