// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/space_figure.hpp"

#include <gtest/gtest.h>

#include <string>

namespace polhode::study::space_figure_test {
namespace {

TEST(SpaceFigure, HidesOneHalfOfTheEllipsoid) {
  const Place semi = {3, 2, 1};
  for (const Place& p : {Place{3, 0, 0}, Place{0, 2, 0}, Place{0, 0, 1}})
    EXPECT_NE(is_in_front(p, semi), is_in_front({-p[0], -p[1], -p[2]}, semi));
  EXPECT_TRUE(is_in_front({0, 0, 1}, semi));  // it is seen from above
}

TEST(SpaceFigure, SplitsACurveInWhatIsInFrontAndBehind) {
  SpaceFigure figure{
      .name = "f", .title = "T", .columns = {"x", "y", "z"}, .semi_axes = Place{1, 1, 1}, .methods = {"rk4"}};
  figure.curves.push_back({.label = "rk4", .points = {{0, 0, 1}, {0, 0.6, 0.8}, {0, 0, -1}, {0, -0.6, -0.8}}});
  const std::string data = space_data(figure);
  EXPECT_NE(data.find("# rk4, in front\n0 0 1\n"), std::string::npos) << data;
  EXPECT_NE(data.find("# rk4, behind\n0 0 -1\n"), std::string::npos) << data;
  EXPECT_NE(space_script(figure).find("data index 2 with lines"), std::string::npos);
}

}  // namespace
}  // namespace polhode::study::space_figure_test
