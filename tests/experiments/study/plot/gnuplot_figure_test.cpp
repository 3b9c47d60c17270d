// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/gnuplot_figure.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "experiments/study/plot/figure_layout.hpp"

namespace polhode::study::gnuplot_figure_test {
namespace {

Figure figure_of(std::size_t panels, std::size_t columns, const std::string& title) {
  Figure figure{.name = "f", .title = "A title", .methods = {"rk4"}, .used_methods = {0}, .variants = {""}};
  std::vector<Panel> all(panels);
  for (Panel& panel : all) panel.title = {title};
  add_rows(figure, std::move(all), columns);
  return figure;
}

/// The first number that follows those words of the script, a height from 0 at the foot of the figure to 1.
double height(const std::string& script, const std::string& words) {
  std::smatch found;
  return std::regex_search(script, found, std::regex(words + "([0-9.]+)")) ? std::stod(found[1]) : -1;
}

TEST(GnuplotFigure, HasItsLegendAboveItsPanelsIfItIsHigh) {
  for (const std::size_t rows : {1U, 2U, 5U}) {
    const std::string script = gnuplot_script(figure_of(rows, 1, "peters_hsu"));
    const double legend = height(script, "set key at screen 0.5,"), panel = height(script, "set tmargin at screen ");
    EXPECT_GT(legend, 0);
    EXPECT_LT(panel, 1);
    EXPECT_EQ(legend > panel, rows > 1) << rows << ": " << legend << " and " << panel;
  }
}

TEST(GnuplotFigure, ContinuesALongTitleOfAPanelInAnotherRow) {
  const auto title = [](const std::string& text) {
    const std::string script = gnuplot_script(figure_of(3, 3, text));
    const auto at = script.find("set title ") + 10;
    return script.substr(at, script.find(" noenhanced", at) - at);
  };
  EXPECT_EQ(title("rk4"), "'rk4'");
  EXPECT_EQ(title("odeint_adams_bashforth_moulton"), R"('odeint_adams_'."\n".'bashforth_moulton')");
  EXPECT_EQ(title("dt = 0.001 s and a tolerance of 1e-10"), R"('dt = 0.001 s and a '."\n".'tolerance of 1e-10')");
  EXPECT_EQ(title("odeint.adams.bashforth.moulton"), "'odeint.adams.bashfort…'");
}

}  // namespace
}  // namespace polhode::study::gnuplot_figure_test
