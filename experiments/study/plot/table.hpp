// SPDX-License-Identifier: BSD-3-Clause
// A table of texts, printed as HTML, Markdown or LaTeX.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace polhode::study::inline plot {

struct Column {
  enum class Kind { name, number, text };
  std::string header;
  std::string unit{};  ///< printed behind the header; empty: none
  Kind kind = Kind::number;
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
  spoken  ///< for screen readers only, if the page shows it elsewhere
};
std::string html(const Table& table, Caption caption = Caption::shown);
std::string markdown(const Table& table);
/// A tabular in booktabs style; a longtable above 40 rows.
std::string latex(const Table& table);

}  // namespace polhode::study::plot
