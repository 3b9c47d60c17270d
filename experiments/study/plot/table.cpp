// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/table.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline plot {

namespace {

std::string header_of(const Column& column) {
  return column.unit.empty() ? column.header : fmt::format("{} ({})", column.header, column.unit);
}

void add_html_cell(std::string& out, const Column& column, const std::string& cell, bool heads_row) {
  constexpr std::size_t short_text = 24;  // length of a text that is not worth a line break
  const char* tag = heads_row ? "th" : "td";
  const char* kind = column.kind == Column::Kind::number ? "number"
                     : column.kind == Column::Kind::name ? "name"
                     : length(cell) <= short_text        ? "short"
                                                         : "text";
  const char* tie = cell.find(" ≈ ") == std::string::npos ? "" : " tie";
  fmt::format_to(std::back_inserter(out), FMT_COMPILE("<{}{} class=\"{}{}\">{}</{}>"), tag,
                 heads_row ? " scope=\"row\"" : "", kind, tie,
                 cell.empty() ? "<span class=\"none\" title=\"not defined\">–</span>" : text::html(cell), tag);
}

/// The number that a cell states: "2.3e-5", "≥ 60", "none to 317"; absent: none.
std::optional<double> number_of_cell(std::string_view text) {
  for (const std::string_view before : {"≥ ", "≤ ", "none to "}) {
    if (text.starts_with(before)) text.remove_prefix(before.size());
  }
  return printed_number(text);
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
    for (std::size_t c = 0; c < row.size(); ++c) add_html_cell(out, table.columns[c], row[c], c == 0);
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table>\n</div>\n";
}

std::vector<std::vector<bool>> best_cells(const Table& table) {
  std::vector<std::vector<bool>> best(table.rows.size(), std::vector<bool>(table.columns.size(), false));
  std::map<std::vector<std::string>, std::vector<std::size_t>> compared;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    std::vector<std::string> group;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (table.columns[c].apart) group.push_back(table.rows[r][c]);
    }
    compared[group].push_back(r);
  }
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (table.columns[c].best == Column::Best::none) continue;
    const double sign = table.columns[c].best == Column::Best::least ? 1 : -1;
    for (const auto& [group, rows] : compared) {
      std::vector<std::pair<double, std::size_t>> found;
      for (const std::size_t r : rows) {
        if (const auto x = number_of_cell(table.rows[r][c])) found.emplace_back(sign * *x, r);
      }
      if (found.empty()) continue;
      const auto [low, high] = std::minmax_element(found.begin(), found.end());
      if (low->first == high->first) continue;
      for (const auto& [x, r] : found) best[r][c] = x == low->first;
    }
  }
  return best;
}

std::string words_for_best(const Table& table) {
  const auto best = best_cells(table);
  const bool marked = std::any_of(best.begin(), best.end(),
                                  [](const auto& row) { return std::find(row.begin(), row.end(), true) != row.end(); });
  if (!marked) return {};
  std::vector<std::string> within;
  for (const Column& column : table.columns) {
    if (column.apart) within.push_back(column.header);
  }
  return within.empty() ? "Bold: the best of its column"
                        : fmt::format("Bold: the best of its column for each {}", words(within));
}

std::string markdown(const Table& table) {
  const auto best = best_cells(table);
  std::string out = "|", rule = "|";
  for (const auto& column : table.columns) {
    out += fmt::format(" {} |", text::markdown(header_of(column)));
    rule += column.kind == Column::Kind::number ? " ---: |" : " --- |";
  }
  out += "\n" + rule + "\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    out += "|";
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const char* mark = best[r][c] ? "**" : "";
      fmt::format_to(std::back_inserter(out), FMT_COMPILE(" {}{}{} |"), mark, text::markdown(table.rows[r][c]), mark);
    }
    out += "\n";
  }
  return out;
}

std::string csv(const Table& table) {
  const auto best = best_cells(table);
  std::vector<std::string> header;
  for (const Column& column : table.columns) header.push_back(header_of(column));
  header.emplace_back("best");
  std::string out = csv_row(header);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    std::vector<std::string> row = table.rows[r], of;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (best[r][c]) of.push_back(table.columns[c].header);
    }
    row.push_back(fmt::format("{}", fmt::join(of, "; ")));
    out += csv_row(row);
  }
  return out;
}

}  // namespace polhode::study::plot
