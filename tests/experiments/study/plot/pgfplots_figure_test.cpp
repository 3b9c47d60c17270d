// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/pgfplots_figure.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_layout.hpp"

namespace polhode::study::pgfplots_figure_test {
namespace {

Figure empty_figure(std::vector<std::string> methods) {
  return {.name = "f", .title = "A title", .methods = std::move(methods), .variants = {""}};
}

TEST(PgfplotsFigure, TellsApartWhatIsCloseTogetherFarFromZero) {
  Figure figure = empty_figure({"rk4"});
  Panel panel{.x = time_axis(1), .y = linear_axis("energy (J)", 0.4, 0.400009)};
  panel.curves = {{.label = "rk4", .points = {{0, 0.4000012, 0.4000012}, {1, 0.4000014, 0.4000014}}}};
  add_rows(figure, {panel}, 1);
  note_marks(figure);
  const std::string text = pgfplots(figure).front();
  EXPECT_NE(text.find("(0,1.2e-06) (1,1.4e-06)"), std::string::npos) << text;
  EXPECT_NE(text.find("$0.400002$"), std::string::npos) << text;
}

TEST(PgfplotsFigure, HasOnEachPageTheLegendOfWhatStandsThere) {
  const std::vector<std::string> methods = {"rk4", "heun", "dmv", "simo_wong", "gauss4", "gauss6"};
  Figure figure = empty_figure(methods);
  std::vector<Panel> panels;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    Panel panel{.x = time_axis(1), .y = linear_axis("energy (J)", 0, 1)};
    panel.curves = {{.label = methods[m], .method = m, .points = {{0, 0, 0}, {1, 1, 1}}}};
    panels.push_back(panel);
  }
  add_rows(figure, panels, 1);
  note_marks(figure);
  const auto pages = pgfplots(figure);
  ASSERT_GT(pages.size(), 1U);
  for (const std::string method : {"rk4", "gauss6"}) {
    const std::string entry = "\\addlegendentry{" + method + "}";
    EXPECT_EQ(pages.front().find(entry) != std::string::npos, method == std::string("rk4"));
    EXPECT_EQ(pages.back().find(entry) != std::string::npos, method == std::string("gauss6"));
  }
}

TEST(PgfplotsFigure, ShortensTheNameOfACrossToTheRoomBesideIt) {
  const std::string name = "odeint_adams_bashforth_moulton";
  Figure figure = empty_figure({name});
  std::vector<Panel> panels(2);
  for (Panel& panel : panels) {
    panel.x = step_axis("step h = dt (s)", {1e-3, 1});
    panel.y = log_axis("energy drift (relative)", {1e-3, 1}, {.crosses = 1});
    panel.curves = {{.label = name, .points = {{0.03, 2000, 0, Mark::edge}, {1, 2000, 0, Mark::edge}}}};
  }
  share_y_axis(panels, panels.front().y);
  add_rows(figure, panels, 2);
  note_marks(figure);
  ASSERT_EQ(figure.panels.front().names.size(), 1U);
  const NameMark& mark = figure.panels.front().names.front();
  EXPECT_TRUE(mark.left);
  EXPECT_FALSE(mark.opaque);
  EXPECT_TRUE(mark.name.starts_with("odeint_a") && mark.name.ends_with("…")) << mark.name;
  EXPECT_EQ(mark.x, 0.03);
}

}  // namespace
}  // namespace polhode::study::pgfplots_figure_test
