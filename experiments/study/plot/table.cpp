// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline plot {

namespace {

constexpr std::size_t most_rows_of_a_tabular = 40;

std::string header_of(const Column& column) {
  return column.unit.empty() ? column.header : fmt::format("{} ({})", column.header, column.unit);
}

std::string html_cell(const Column& column, const std::string& cell, bool heads_row) {
  constexpr std::size_t short_text = 24;  // not worth a line break
  const char* tag = heads_row ? "th" : "td";
  const char* kind = column.kind == Column::Kind::number ? "number"
                     : column.kind == Column::Kind::name ? "name"
                     : length(cell) <= short_text        ? "short"
                                                         : "text";
  return fmt::format("<{}{} class=\"{}\">{}</{}>", tag, heads_row ? " scope=\"row\"" : "", kind,
                     cell.empty() ? "<span class=\"none\" title=\"not defined\">–</span>" : text::html(cell), tag);
}

std::string latex_cell(const Column& column, const std::string& cell) {
  if (cell.empty()) return "--";
  switch (column.kind) {
    case Column::Kind::number: return tex_number(cell);
    case Column::Kind::name: return fmt::format("\\texttt{{{}}}", tex(cell));
    default: return tex(cell);
  }
}

/// A long header in lines of a few words each, so that its column is no wider than its numbers.
std::string latex_header(const Column& column) {
  constexpr std::size_t line_length = 12;
  std::vector<std::string> lines = {""};
  std::istringstream text(header_of(column));
  for (std::string word; text >> word;) {
    if (!lines.back().empty() && length(lines.back()) + 1 + length(word) > line_length) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  for (auto& line : lines) line = tex(line);
  if (lines.size() == 1) return lines.front();
  return fmt::format("\\shortstack[{}]{{{}}}", column.kind == Column::Kind::number ? "r" : "l",
                     fmt::join(lines, "\\\\"));
}

std::string latex_row(const std::vector<std::string>& cells) {
  return fmt::format("{} \\\\\n", fmt::join(cells, " & "));
}

}  // namespace

Table without_empty_columns(Table table) {
  for (std::size_t c = table.columns.size(); c-- > 0;) {
    if (std::any_of(table.rows.begin(), table.rows.end(), [&](const auto& row) { return !row[c].empty(); })) continue;
    const auto at = static_cast<std::ptrdiff_t>(c);
    table.columns.erase(table.columns.begin() + at);
    for (auto& row : table.rows) row.erase(row.begin() + at);
  }
  return table;
}

std::string html(const Table& table, Caption caption) {
  // A table wider than the screen scrolls in its own region, which the keyboard can reach.
  std::string out = fmt::format("<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"{}\">\n<table>\n",
                                text::html(table.caption));
  if (!table.caption.empty() && caption == Caption::shown)
    out += fmt::format("<caption><span class=\"caption\">{}</span></caption>\n", text::html(table.caption));
  out += "<thead><tr>";
  for (const auto& column : table.columns) {
    out += fmt::format("<th scope=\"col\"{}>{}</th>", column.kind == Column::Kind::number ? " class=\"number\"" : "",
                       text::html(header_of(column)));
  }
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) out += html_cell(table.columns[c], row[c], c == 0);
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table>\n</div>\n";
}

std::string markdown(const Table& table) {
  std::string out = "|", rule = "|";
  for (const auto& column : table.columns) {
    out += fmt::format(" {} |", text::markdown(header_of(column)));
    rule += column.kind == Column::Kind::number ? " ---: |" : " --- |";
  }
  out += "\n" + rule + "\n";
  for (const auto& row : table.rows) {
    out += "|";
    for (const auto& cell : row) out += fmt::format(" {} |", text::markdown(cell));
    out += "\n";
  }
  return out;
}

std::string latex(const Table& table) {
  std::string alignment, body;
  std::vector<std::string> headers;
  for (const auto& column : table.columns) {
    alignment += column.kind == Column::Kind::number ? 'r' : 'l';
    headers.push_back(latex_header(column));
  }
  for (const auto& row : table.rows) {
    std::vector<std::string> cells;
    for (std::size_t c = 0; c < row.size(); ++c) cells.push_back(latex_cell(table.columns[c], row[c]));
    body += latex_row(cells);
  }
  const auto head = latex_row(headers);
  if (table.rows.size() <= most_rows_of_a_tabular) {
    return fmt::format("\\begin{{tabular}}{{{}}}\n\\toprule\n{}\\midrule\n{}\\bottomrule\n\\end{{tabular}}\n",
                       alignment, head, body);
  }
  return fmt::format(
      "\\begin{{longtable}}{{{}}}\n\\toprule\n{}\\midrule\n\\endhead\n\\bottomrule\n\\endfoot\n{}\\end{{longtable}}\n",
      alignment, head, body);
}

}  // namespace polhode::study::plot
