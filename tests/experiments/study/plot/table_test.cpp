// SPDX-License-Identifier: BSD-3-Clause
// Tables as Markdown, CSV and LaTeX: what is best is marked, and they fit a line.
#include "experiments/study/plot/table.hpp"

#include <gtest/gtest.h>

#include "experiments/study/plot/latex_table.hpp"
#include "experiments/study/plot/tex_width.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::table_test {
namespace {

using Best = Column::Best;

Table errors() {
  return {.caption = "Errors",
          .columns = {{.header = "method", .kind = Column::Kind::name},
                      {.header = "motion", .kind = Column::Kind::text, .apart = true},
                      {.header = "error", .best = Best::least},
                      {.header = "stands", .unit = "s", .best = Best::greatest},
                      {.header = "cost"}},
          .rows = {{"rk4", "top", "1e-3", "≥ 60", "4"},
                   {"dmv", "top", "2e-4", "7", "1"},
                   {"heun", "top", "2e-4", "", "2"},
                   {"rk4", "box", "5", "none", "4"},
                   {"dmv", "box", "5", "7", "1"}}};
}

TEST(Tables, MarkTheBestOfEachMotion) {
  const auto best = best_cells(errors());
  std::string marks;
  for (const auto& row : best) {
    for (const bool b : row) marks += b ? 'x' : '-';
    marks += ' ';
  }
  // Two are equal; of the box both are; ≥ 60 is 60; a text and an empty cell are none; a cost has no direction.
  EXPECT_EQ(marks, "---x- --x-- --x-- ----- ----- ");
  EXPECT_EQ(words_for_best(errors()), "Bold: the best of its column for each motion");
  Table none = errors();
  none.columns[2].best = none.columns[3].best = Best::none;
  EXPECT_EQ(words_for_best(none), "");
}

TEST(Tables, SayWhatIsBestInMarkdownCsvAndLatex) {
  EXPECT_NE(markdown(errors()).find("| dmv | top | **2e-4** | 7 | 1 |"), std::string::npos) << markdown(errors());
  EXPECT_EQ(csv(errors()),
            "method,motion,error,stands (s),cost,best\nrk4,top,1e-3,≥ 60,4,stands\ndmv,top,2e-4,7,1,error\n"
            "heun,top,2e-4,,2,error\nrk4,box,5,none,4,\ndmv,box,5,7,1,\n");
  const std::string tex = latex_table(errors()).text;
  EXPECT_NE(tex.find("\\texttt{dmv} & top & $\\mathbf{2\\times10^{-4}}$ & $7$ & $1$"), std::string::npos) << tex;
}

TEST(Tables, ATieIsGreyOnThePage) {
  const Table table{
      "", {{"motion", "", Column::Kind::name}, {"1e-6", "", Column::Kind::text}}, {{"top", "a ≈ b"}, {"box", "a"}}};
  EXPECT_NE(html(table).find("<td class=\"short tie\">a ≈ b</td>"), std::string::npos) << html(table);
  EXPECT_NE(html(table).find("<td class=\"short\">a</td>"), std::string::npos) << html(table);
}

/// The tables below each other: number of \begin{tabular} or \begin{longtable}.
std::size_t parts(const std::string& tex) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = tex.find("\\toprule", at)) != std::string::npos; ++at) ++n;
  return n;
}

TEST(Tables, FitALineByBreaksAndByTablesBelowEachOther) {
  Table table = errors();
  EXPECT_EQ(parts(latex_table(table).text), 1U);
  EXPECT_FALSE(latex_table(table).over_pages);
  for (int k = 0; k < 12; ++k) {
    table.columns.push_back({.header = "quantity " + std::to_string(k)});
    for (auto& row : table.rows) row.emplace_back("-1.23e-12");
  }
  const LatexTable wide = latex_table(table);
  EXPECT_GT(parts(wide.text), 1U);
  std::size_t repeated = 0;
  for (std::size_t at = 0; (at = wide.text.find("\\texttt{heun}", at)) != std::string::npos; ++at) ++repeated;
  EXPECT_EQ(repeated, parts(wide.text));
  for (int i = 0; i < 100; ++i) table.rows.push_back(table.rows.front());
  EXPECT_TRUE(latex_table(table).over_pages);
  EXPECT_NE(latex_table(table).text.find("\\begin{longtable}"), std::string::npos);
}

TEST(Tables, WidthsAreThoseOfLatinModern) {
  EXPECT_NEAR(tex_width("0123456789", 10), 50, 0.01);
  EXPECT_NEAR(tex_width("rk4", 10, TexFont::typewriter), 15.75, 0.01);
  EXPECT_GT(tex_number_width("2.3e-12", 9), tex_width("2.3", 9) + tex_width("10", 9));
  EXPECT_DOUBLE_EQ(tex_number_width("none", 9), tex_width("none", 9));
}

TEST(Tables, TexHasNoCharacterThatItsFontsLack) {
  EXPECT_EQ(tex("|ω| ≥ 3 é"), "|$\\omega$| $\\geq$ 3 é");
  EXPECT_EQ(tex("中"), "[U+4E2D]");
  EXPECT_EQ(tex("😀"), "[U+1F600]");
  EXPECT_EQ(tex_number("1-2"), "1-2");  // no number
  EXPECT_EQ(tex_breakable("a_b c"), "a\\_\\allowbreak{}b c");
}

}  // namespace
}  // namespace polhode::study::table_test
