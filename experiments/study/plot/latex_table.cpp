// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/latex_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <sstream>

#include "experiments/study/plot/tex_width.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline plot {
namespace tabular {  // a namespace of its own, since several files of this folder are compiled together
namespace {

constexpr double gap = 5;                             // gap between columns, pt
constexpr double room_of_line = tex_line_width - 3;   // width of a line; widths are exact to a hundredth
constexpr double most_of_keys = 0.62 * room_of_line;  // share of the line for the columns that are repeated
constexpr std::size_t most_lines = 42;                // lines of a table on one page, its headings among them
constexpr std::size_t header_length = 12;             // characters of a line of a heading
constexpr std::size_t longest_piece = 24;             // characters without a place to break

enum class Size { footnotesize, scriptsize };
constexpr double points(Size size) { return size == Size::footnotesize ? 9 : 8; }
constexpr const char* name(Size size) { return size == Size::footnotesize ? "footnotesize" : "scriptsize"; }

/// The pieces of a text between which a line may break: at blanks, and after signs within names.
std::vector<std::string> pieces_of(std::string_view text) {
  std::vector<std::string> pieces = {""};
  std::size_t since = 0;
  for (const char c : text) {
    const bool begins_character = (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    if (since >= longest_piece && begins_character) pieces.emplace_back(), since = 0;
    pieces.back() += c;
    since += begins_character ? 1 : 0;
    if (c == ' ' || c == '_' || c == '/' || c == ',' || c == '=' || c == '|') pieces.emplace_back(), since = 0;
  }
  if (pieces.back().empty() && pieces.size() > 1) pieces.pop_back();
  return pieces;
}

std::vector<std::string> header_lines(const Column& column) {
  const std::string header = column.unit.empty() ? column.header : fmt::format("{} ({})", column.header, column.unit);
  std::vector<std::string> lines = {""};
  for (const std::string& piece : pieces_of(header)) {
    if (!lines.back().empty() && length(lines.back()) + length(piece) > header_length + 1) lines.emplace_back();
    lines.back() += piece;
  }
  for (auto& line : lines) line.erase(line.find_last_not_of(' ') + 1);
  return lines;
}

TexFont font_of(const Column& column) {
  return column.kind == Column::Kind::name ? TexFont::typewriter : TexFont::roman;
}

double width_of(const Column& column, const std::string& cell, double size, bool bold) {
  if (cell.empty()) return tex_width("--", size);
  const auto font = bold ? TexFont::bold : font_of(column);
  return column.kind == Column::Kind::number ? tex_number_width(cell, size, font) : tex_width(cell, size, font);
}

/// A column in one size of letters.
struct Measured {
  double natural = 0;  ///< width on one line, pt
  double least = 0;    ///< width with all breaks that there may be, pt; numbers do not break
  double header = 0;
};

Measured measured(const Table& table, const std::vector<std::vector<bool>>& best, std::size_t c, double size) {
  const Column& column = table.columns[c];
  Measured found;
  for (const std::string& line : header_lines(column)) found.header = std::max(found.header, tex_width(line, size));
  found.natural = found.least = found.header;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string& cell = table.rows[r][c];
    const double width = width_of(column, cell, size, best[r][c]);
    found.natural = std::max(found.natural, width);
    if (column.kind == Column::Kind::number) {
      found.least = found.natural;
      continue;
    }
    for (const std::string& piece : pieces_of(cell))
      found.least = std::max(found.least, 1 + tex_width(piece, size, font_of(column)));
  }
  return found;
}

/// The columns of one of the tables below each other, and the width of each where its texts break; 0: as wide as
/// needed.
struct Part {
  std::vector<std::size_t> columns;
  std::vector<double> widths;
};

struct Layout {
  Size size = Size::footnotesize;
  std::vector<Part> parts;
};

class Layouter {
 public:
  Layouter(const Table& table, const std::vector<std::vector<bool>>& best) : table_(table), best_(best) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) all_.push_back(c);
  }

  /// True if the columns that tell the rows apart leave little room for the others in a table that was split.
  bool crowded() const { return crowded_; }

  Layout layout() {
    for (const Size size : {Size::footnotesize, Size::scriptsize}) {
      measure(size);
      if (total(all_) <= room_of_line) return {size, {whole(all_)}};
    }
    for (const Size size : {Size::footnotesize, Size::scriptsize}) {
      measure(size);
      if (auto broken = with_breaks(all_, size == Size::footnotesize ? 2 : 3)) return {size, {*broken}};
    }
    measure(Size::footnotesize);
    return {Size::footnotesize, split()};
  }

 private:
  void measure(Size size) {
    measured_.clear();
    for (const std::size_t c : all_) measured_.push_back(measured(table_, best_, c, points(size)));
  }

  double total(const std::vector<std::size_t>& columns) const {
    double sum = gap * static_cast<double>(columns.size() - 1);
    for (const std::size_t c : columns) sum += measured_[c].natural;
    return sum;
  }

  Part whole(const std::vector<std::size_t>& columns) const {
    return {columns, std::vector<double>(columns.size(), 0)};
  }

  /// The columns with texts in up to `lines` lines, if they fit so.
  std::optional<Part> with_breaks(const std::vector<std::size_t>& columns, double lines) const {
    Part part = whole(columns);
    double least = gap * static_cast<double>(columns.size() - 1), room = 0;
    std::vector<double> lows;
    for (const std::size_t c : columns) {
      const Measured& m = measured_[c];
      lows.push_back(std::min(m.natural, std::max(m.least, 1.15 * m.natural / lines)));
      least += lows.back();
      room += m.natural - lows.back();
    }
    if (least > room_of_line) return std::nullopt;
    const double share = room > 0 ? std::min(1.0, (room_of_line - least) / room) : 1;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double natural = measured_[columns[k]].natural;
      if (lows[k] < natural && share < 1) part.widths[k] = lows[k] + share * (natural - lows[k]);
    }
    return part;
  }

  /// The columns that tell the rows apart, and with them as many of the others as fit, again and again.
  std::vector<Part> split() {
    std::vector<std::size_t> keys, others;
    for (const std::size_t c : all_) (is_key(c) ? keys : others).push_back(c);
    Part head = whole(keys);
    double width = total(keys);
    for (const double lines : {1.0, 2.0, 3.0, 8.0}) {
      if (width <= most_of_keys) break;
      head = narrowed(keys, lines);
      width = width_of_part(head);
    }
    crowded_ = width > most_of_keys;
    std::vector<Part> parts = {head};
    double filled = width;
    for (const std::size_t c : others) {
      const Measured& m = measured_[c];
      const double wide = std::min(m.natural, std::max(m.least, 110.0));
      if (filled + gap + wide > room_of_line && parts.back().columns.size() > keys.size()) {
        parts.push_back(head);
        filled = width;
      }
      parts.back().columns.push_back(c);
      parts.back().widths.push_back(wide < m.natural ? wide : 0);
      filled += gap + wide;
    }
    return parts;
  }

  Part narrowed(const std::vector<std::size_t>& columns, double lines) const {
    Part part = whole(columns);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const Measured& m = measured_[columns[k]];
      const double wide = std::max(m.least, 1.15 * m.natural / lines);
      if (wide < m.natural) part.widths[k] = wide;
    }
    return part;
  }

  double width_of_part(const Part& part) const {
    double sum = gap * static_cast<double>(part.columns.size() - 1);
    for (std::size_t k = 0; k < part.columns.size(); ++k)
      sum += part.widths[k] > 0 ? part.widths[k] : measured_[part.columns[k]].natural;
    return sum;
  }

  /// Marked as such; in a table without such columns those before the first number.
  bool is_key(std::size_t c) const {
    const auto& columns = table_.columns;
    if (columns[c].key || c == 0) return true;
    if (std::any_of(columns.begin(), columns.end(), [](const Column& x) { return x.key; })) return false;
    const auto is_number = [](const Column& x) { return x.kind == Column::Kind::number; };
    return std::none_of(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(c) + 1, is_number) &&
           std::any_of(columns.begin(), columns.end(), is_number);
  }

  const Table& table_;
  const std::vector<std::vector<bool>>& best_;
  std::vector<std::size_t> all_;
  std::vector<Measured> measured_;
  bool crowded_ = false;
};

/// The table with the number of each row in a column of its own, which alone is repeated in the tables below each
/// other.
Table numbered(Table table) {
  for (Column& column : table.columns) column.key = false;
  table.columns.insert(table.columns.begin(), {.header = "row", .key = true});
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    table.rows[r].insert(table.rows[r].begin(), std::to_string(r + 1));
  return table;
}

std::string cell_of(const Column& column, const std::string& cell, bool best, bool breaks) {
  if (cell.empty()) return "--";
  switch (column.kind) {
    case Column::Kind::number: {
      std::string number = tex_number(cell);
      if (!best) return number;
      if (!printed_number(cell)) return fmt::format("\\textbf{{{}}}", number);
      return fmt::format("$\\mathbf{{{}}}$", number.substr(1, number.size() - 2));
    }
    case Column::Kind::name: return fmt::format("\\texttt{{{}}}", breaks ? tex_breakable(cell) : tex(cell));
    default: return breaks ? tex_breakable(cell) : tex(cell);
  }
}

std::string header_of(const Column& column) {
  std::vector<std::string> lines;
  for (const std::string& line : header_lines(column)) lines.push_back(tex(line));
  if (lines.size() == 1) return lines.front();
  return fmt::format("\\shortstack[{}]{{{}}}", column.kind == Column::Kind::number ? "r" : "l",
                     fmt::join(lines, "\\\\"));
}

/// Lines of a text in a column of this width.
std::size_t lines_of(const std::string& cell, double width, double size, TexFont font) {
  std::size_t lines = 1;
  double filled = 0;
  for (const std::string& piece : pieces_of(cell)) {
    const double wide = tex_width(piece, size, font);
    if (filled > 0 && filled + wide > width) ++lines, filled = 0;
    filled += wide;
  }
  return lines;
}

std::size_t lines_of(const Table& table, const Part& part, double size) {
  std::size_t header = 1, lines = 2;  // the rules
  for (const std::size_t c : part.columns) header = std::max(header, header_lines(table.columns[c]).size());
  for (const auto& row : table.rows) {
    std::size_t most = 1;
    for (std::size_t k = 0; k < part.columns.size(); ++k) {
      const std::size_t c = part.columns[k];
      if (part.widths[k] > 0) most = std::max(most, lines_of(row[c], part.widths[k], size, font_of(table.columns[c])));
    }
    lines += most;
  }
  return lines + header;
}

std::string row_text(const std::vector<std::string>& cells) {
  return fmt::format("{} \\\\\n", fmt::join(cells, " & "));
}

std::string text_of(const Table& table, const std::vector<std::vector<bool>>& best, const Part& part, bool over_pages) {
  std::string alignment, body;
  std::vector<std::string> headers;
  for (std::size_t k = 0; k < part.columns.size(); ++k) {
    const Column& column = table.columns[part.columns[k]];
    alignment += part.widths[k] > 0 ? fmt::format(">{{\\raggedright\\arraybackslash}}p{{{:.1f}pt}}", part.widths[k])
                 : column.kind == Column::Kind::number ? "r"
                                                       : "l";
    headers.push_back(header_of(column));
  }
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    std::vector<std::string> cells;
    for (std::size_t k = 0; k < part.columns.size(); ++k) {
      const std::size_t c = part.columns[k];
      cells.push_back(cell_of(table.columns[c], table.rows[r][c], best[r][c], part.widths[k] > 0));
    }
    body += row_text(cells);
  }
  const std::string head = row_text(headers);
  if (!over_pages)
    return fmt::format(
        "\\begin{{tabular}}{{@{{}}{}@{{}}}}\n\\toprule\n{}\\midrule\n{}\\bottomrule\n\\end{{tabular}}\\par\n",
        alignment, head, body);
  return fmt::format(
      "\\begin{{longtable}}{{@{{}}{}@{{}}}}\n\\toprule\n{}\\midrule\n\\endhead\n\\bottomrule\n\\endfoot\n{}\\end{{"
      "longtable}}\\addtocounter{{table}}{{-1}}%\n",
      alignment, head, body);
}

}  // namespace
}  // namespace tabular

std::string tex_breakable(std::string_view utf8) {
  std::string out;
  for (const std::string& piece : tabular::pieces_of(utf8)) {
    if (!out.empty() && !out.ends_with(' ')) out += "\\allowbreak{}";
    out += tex(piece);
  }
  return out;
}

namespace {

LatexTable in_latex(const Table& table, const tabular::Layout& layout, const std::vector<std::vector<bool>>& best) {
  using namespace tabular;
  std::size_t lines = 0;
  for (const tabular::Part& part : layout.parts) lines += tabular::lines_of(table, part, points(layout.size));
  LatexTable made{.text = {}, .over_pages = lines > most_lines};
  made.text = fmt::format("{{\\{}\\setlength{{\\tabcolsep}}{{{}pt}}{}%\n", tabular::name(layout.size), gap / 2,
                          made.over_pages ? "" : "\\centering");
  for (std::size_t p = 0; p < layout.parts.size(); ++p) {
    if (p > 0 && !made.over_pages) made.text += "\\medskip\n";
    made.text += tabular::text_of(table, best, layout.parts[p], made.over_pages);
  }
  made.text += "}\n";
  return made;
}

}  // namespace

LatexTable latex_table(const Table& table) {
  const auto best = best_cells(table);
  tabular::Layouter layouter(table, best);
  const tabular::Layout layout = layouter.layout();
  if (!layouter.crowded()) return in_latex(table, layout, best);
  const Table by_number = tabular::numbered(table);
  const auto best_by_number = best_cells(by_number);
  return in_latex(by_number, tabular::Layouter(by_number, best_by_number).layout(), best_by_number);
}

}  // namespace polhode::study::plot
