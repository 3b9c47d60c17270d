// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/figure_choice.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "experiments/study/plot/figure_layout.hpp"
#include "experiments/study/plot/gnuplot_figure.hpp"
#include "experiments/study/plot/method_style.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::figure_choice_test {
namespace {

/// Two rows of `columns` panels, of which only those on the left label their y axis.
Figure two_rows(std::size_t columns) {
  Figure figure{.name = "f", .title = "A title", .methods = {"rk4"}, .variants = {""}};
  add_rows(figure, std::vector<Panel>(2 * columns), columns);
  return figure;
}

TEST(FigureWidth, IsAWordOrANumber) {
  EXPECT_EQ(read_figure_width("one_column", "--figure-width"), 8.6);
  EXPECT_EQ(read_figure_width("two_columns", "--figure-width"), 17.8);
  EXPECT_EQ(read_figure_width("12.7", "--figure-width"), 12.7);
  for (const char* wrong : {"", "wide", "4", "61", "12cm", "nan", "-9"})
    EXPECT_THROW(read_figure_width(wrong, "--figure-width"), InputError) << wrong;
}

TEST(FigureFont, IsAFamilyASizeOrBoth) {
  FigureLook look;
  read_figure_font("DejaVu Serif", "--figure-font", look);
  EXPECT_EQ(look.font, "DejaVu Serif");
  EXPECT_EQ(look.font_size, 9);
  read_figure_font(",11", "--figure-font", look);
  EXPECT_EQ(look.font, "DejaVu Serif");
  EXPECT_EQ(look.font_size, 11);
  read_figure_font("Latin Modern Roman,10.5", "--figure-font", look);
  EXPECT_EQ(look.font, "Latin Modern Roman");
  EXPECT_EQ(look.font_size, 10.5);
  for (const char* wrong : {"", "a,b", "a,3", "a,41", "it's", "a\"b", "a,9,9"})
    EXPECT_THROW(read_figure_font(wrong, "--figure-font", look), InputError) << wrong;
}

TEST(FigureStyles, AreThoseOfItsOwnMethods) {
  FigureSet set;
  set.figures.assign(3, two_rows(1));
  set.figures[0].methods = set.figures[2].methods = {"float", "double"};
  set.figures[1].methods = {"heun", "rk4"};
  EXPECT_EQ(first_styles(set), (std::vector<std::size_t>{0, 2, 0}));
  const std::string style = gnuplot_style(set);
  const std::string rk4 = "set style line 4 linecolor rgb '" + html_colour(styles_of({"rk4"}).front()) + "'";
  EXPECT_NE(style.find(rk4), std::string::npos) << style;
  EXPECT_EQ(style.find("# float"), style.rfind("# float"));
}

TEST(FigureChoice, RemovesFiguresAndGivesTheOthersTheirLook) {
  std::vector<Figure> figures = {two_rows(1), two_rows(1)};
  figures[1].name = "g";
  FigureChoice choice;
  choice.look.title = true;
  choose_figures(choice, figures);
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_TRUE(figures[0].look.title);
  choice.names = {"g", "h"};
  choose_figures(choice, figures);
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures[0].name, "g");
}

TEST(FittedFigure, PutsPanelsBelowEachOtherWhereTheyWouldBeNarrow) {
  Figure figure = two_rows(3);
  EXPECT_EQ(fitted(figure).columns, 3U);  // at the default width
  figure.look.width_cm = 12.7;
  EXPECT_EQ(fitted(figure).columns, 2U);
  figure.look.width_cm = 8.6;
  const Figure narrow = fitted(figure);
  EXPECT_EQ(narrow.columns, 1U);
  EXPECT_EQ(narrow.rows, 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(narrow.panels[i].row, i);
    EXPECT_EQ(narrow.panels[i].column, 0U);
    EXPECT_TRUE(narrow.panels[i].y.labelled);
  }
}

TEST(FittedFigure, BeginsEachRowOfTheWideOneOnANewRow) {
  Figure figure = two_rows(3);
  figure.look.width_cm = 12.7;
  const Figure fit = fitted(figure);
  EXPECT_EQ(fit.rows, 4U);
  EXPECT_EQ(fit.panels[3].row, 2U);
  EXPECT_EQ(fit.panels[3].column, 0U);
}

TEST(GnuplotScript, HasTheTitleOnlyIfAskedFor) {
  Figure figure = two_rows(1);
  EXPECT_EQ(gnuplot_script(figure).find("set label 'A title'"), std::string::npos);
  figure.look.title = true;
  EXPECT_NE(gnuplot_script(figure).find("set label 'A title'"), std::string::npos);
}

}  // namespace
}  // namespace polhode::study::figure_choice_test
