// SPDX-License-Identifier: BSD-3-Clause
// Figures of made-up studies: the points that are drawn, and the files that gnuplot makes of them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/axis.hpp"
#include "experiments/study/report/figures/study_figures.hpp"
#include "experiments/study/report/page/report.hpp"
#include "tests/experiments/study/report/made_up_study.hpp"
#include "tests/experiments/study/report/result_files.hpp"

namespace polhode::study::report_tests::figures_test {
namespace {

const Figure* find_figure(const FigureSet& set, const std::string& name) {
  const auto at = std::find_if(set.figures.begin(), set.figures.end(), [&](const auto& f) { return f.name == name; });
  return at == set.figures.end() ? nullptr : &*at;
}

std::vector<Point> points_with(const Figure& figure, Mark mark) {
  std::vector<Point> found;
  for (const auto& panel : figure.panels) {
    for (const auto& curve : panel.curves) {
      std::copy_if(curve.points.begin(), curve.points.end(), std::back_inserter(found),
                   [&](const auto& p) { return p.mark == mark; });
    }
  }
  return found;
}

TEST(ReportFigures, KeepZeroDriftAndDivergedRunsInSight) {
  auto study = power_laws("unused");
  for (auto& run : study.runs) {
    if (run.config.integrator == "rk4") run.result.energy_drift_max_rel = 0;
  }
  // Whatever a diverged run measured before it ended is no result.
  study.runs.front().result.energy_drift_max_rel = 0.5;
  const auto set = figures_of(study, group(study));
  const auto* figure = find_figure(set, "drift_against_step");
  ASSERT_NE(figure, nullptr);
  const auto zeros = points_with(*figure, Mark::zero), edges = points_with(*figure, Mark::edge);
  ASSERT_EQ(zeros.size(), 7U);
  ASSERT_EQ(edges.size(), 1U);
  const auto& axis = figure->panels.front().y;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const auto& point : points_with(*figure, Mark::value)) {
    least = std::min(least, point.drawn);
    most = std::max(most, point.drawn);
  }
  EXPECT_LT(zeros.front().drawn, least);
  EXPECT_GT(zeros.front().drawn, axis.low);
  EXPECT_GT(edges.front().drawn, most);
  EXPECT_LT(edges.front().drawn, axis.high);
  EXPECT_NE(figure->caption.find("exactly zero"), std::string::npos);
  EXPECT_NE(figure->caption.find("diverged"), std::string::npos);
}

TEST(ReportFigures, ShowAMethodOfWhichEveryRunDiverged) {
  auto study = power_laws("unused");
  for (auto& run : study.runs) {
    if (run.config.integrator != "explicit_euler") continue;
    run.result = RunResult{};
    run.result.status = "diverged";
  }
  const auto set = figures_of(study, group(study));
  EXPECT_EQ(points_with(*find_figure(set, "drift_against_step"), Mark::edge).size(), 7U);
}

TEST(ReportFigures, SayWhoseTheCrossesAre) {
  auto study = power_laws("unused");
  for (auto& run : study.runs) {
    if (run.config.dt && *run.config.dt > 0.01) run.result.status = "diverged";
  }
  const auto set = figures_of(study, group(study));
  const Figure& figure = *find_figure(set, "drift_against_step");
  const Panel& panel = figure.panels.front();
  ASSERT_EQ(panel.names.size(), 4U);  // the methods with a fixed step
  std::set<double> lanes;
  for (const NameMark& mark : panel.names) {
    const auto curve = std::find_if(panel.curves.begin(), panel.curves.end(),
                                    [&](const auto& c) { return figure.methods[c.method] == mark.name; });
    ASSERT_NE(curve, panel.curves.end()) << mark.name;
    EXPECT_EQ(curve->method, mark.method);
    std::size_t crosses = 0;
    for (const Point& point : curve->points) {
      if (point.mark != Mark::edge) continue;
      ++crosses;
      EXPECT_EQ(point.drawn, mark.y) << mark.name;
    }
    EXPECT_EQ(crosses, 3U) << mark.name;
    lanes.insert(mark.y);
    EXPECT_NE(figure.caption.find(mark.name), std::string::npos) << figure.caption;
  }
  EXPECT_EQ(lanes.size(), 4U) << "crosses of two methods stand at the same height";
  for (const Point& point : points_with(figure, Mark::value)) EXPECT_LT(point.drawn, *lanes.begin());
}

TEST(ReportFigures, PutUpToTenMethodsInOnePanelAndMoreInPanelsOfNearlyEqualNumbers) {
  const auto methods_by_panel = [](std::size_t methods) {
    auto study = empty_study("unused");
    for (std::size_t m = 0; m < methods; ++m) {
      for (const double step : {0.01, 0.001})
        study.runs.push_back(fake_run({.method = "m" + std::to_string(10 + m), .p = 2}, "top", step));
    }
    const auto set = figures_of(study, group(study));
    std::vector<std::size_t> numbers;
    for (const Panel& panel : find_figure(set, "drift_against_step")->panels) numbers.push_back(panel.curves.size());
    return numbers;
  };
  EXPECT_EQ(methods_by_panel(9), (std::vector<std::size_t>{9}));
  EXPECT_EQ(methods_by_panel(10), (std::vector<std::size_t>{10}));
  EXPECT_EQ(methods_by_panel(11), (std::vector<std::size_t>{5, 6}));
  EXPECT_EQ(methods_by_panel(25), (std::vector<std::size_t>{8, 8, 9}));
}

TEST(ReportFigures, OfErrorAgainstCostNameTheCheapestAndTheNext) {
  auto study = empty_study("unused");
  study.scenarios.push_back(fake_scenario("top"));
  for (int m = 0; m < 12; ++m) {  // each the dearer, the larger its scale
    for (const double step : seven_steps)
      study.runs.push_back(
          fake_run({.method = "m" + std::to_string(10 + m), .scale = std::pow(3, m), .p = 3}, "top", step));
  }
  const auto set = figures_of(study, group(study));
  const Figure* figure = find_figure(set, "error_against_cost");
  ASSERT_NE(figure, nullptr);
  std::set<std::string> coloured;
  for (const PlottedCurve& curve : figure->panels.front().curves) {
    if (!curve.muted) coloured.insert(figure->methods[curve.method]);
  }
  EXPECT_EQ(coloured, (std::set<std::string>{"m10", "m11"}));
  ASSERT_EQ(figure->panels.front().names.size(), 1U);
  EXPECT_EQ(figure->panels.front().names.front().name, "m11");
  EXPECT_EQ(figure->panels.front().envelope.front().label, "m10");
}

TEST(ReportFigures, DrawAllPointsInsideTheirAxes) {
  const auto study = power_laws("unused");
  for (const auto& figure : figures_of(study, group(study)).figures) {
    for (const auto& panel : figure.panels) {
      EXPECT_FALSE(panel.curves.empty()) << figure.name;
      EXPECT_GE(panel.y.ticks.size(), 2U) << figure.name;
      for (const auto& curve : panel.curves) {
        for (const auto& point : curve.points) {
          EXPECT_TRUE(point.x >= panel.x.low && point.x <= panel.x.high) << figure.name << " x " << point.x;
          EXPECT_TRUE(point.drawn >= panel.y.low && point.drawn <= panel.y.high) << figure.name << " y " << point.drawn;
        }
      }
    }
  }
}

TEST(ReportFigures, AreNotMadeWithoutDataAndSayWhy) {
  auto study = power_laws("unused");
  for (auto& run : study.runs) run.result.attitude_error_max = std::nullopt;
  const auto set = figures_of(study, group(study));
  EXPECT_EQ(find_figure(set, "error_against_step"), nullptr);
  ASSERT_EQ(set.absent.size(), 1U);
  EXPECT_EQ(set.absent.front().name, "error_against_step");
  EXPECT_NE(set.absent.front().reason.find("exact solution"), std::string::npos);
}

TEST(ReportFigures, OfOneRunAreAgainstTime) {
  auto study = empty_study("unused");
  study.runs.push_back(fake_run(seven_methods[3], "top", 0.01));
  const auto set = figures_of(study, group(study));
  EXPECT_NE(find_figure(set, "drift_against_time"), nullptr);
  EXPECT_EQ(find_figure(set, "drift_against_step"), nullptr);
  ASSERT_NE(find_figure(set, "momentum"), nullptr);
  EXPECT_EQ(find_figure(set, "momentum")->panels.front().x_column, "t_s");
}

TEST(ReportFigures, LeaveOutEvenlyAndSaySo) {
  auto study = empty_study("unused");
  study.varied_keys = {"body.0.mass"};
  for (int i = 0; i < 9; ++i) {
    for (const double step : {0.01, 0.001}) {
      study.runs.push_back(fake_run(seven_methods[3], "top", step));
      study.runs.back().config.varied = {{"body.0.mass", std::to_string(i)}};
    }
  }
  const auto set = figures_of(study, group(study));
  const auto* figure = find_figure(set, "drift_against_step");
  ASSERT_NE(figure, nullptr);
  EXPECT_EQ(figure->panels.size(), 4U);
  EXPECT_EQ(figure->panels.front().title.back(), "body.0.mass = 0");
  EXPECT_EQ(figure->panels.back().title.back(), "body.0.mass = 8");
  EXPECT_NE(figure->caption.find("4 of 9 cases"), std::string::npos) << figure->caption;
}

TEST(ReportFigures, AreDrawnTheSameTwice) {
  NEEDS_GNUPLOT();
  const Folder folder;
  const auto study = power_laws(folder.path);
  ASSERT_EQ(write_figures(study), "");
  const std::vector<std::string> names = {"drift_against_time", "drift_against_step", "momentum", "orientation_defect",
                                          "error_against_step"};
  const auto bytes_of_all = [&] {
    std::vector<std::string> all;
    for (const auto& name : names) {
      for (const auto* ending : {".svg", ".pdf", ".gp", ".dat", ".tex"})
        all.push_back(read(folder.path / "figures" / (name + ending)));
    }
    return all;
  };
  const auto once = bytes_of_all();
  ::sleep(1);  // a PDF holds the time of day in seconds
  ASSERT_EQ(write_figures(study), "");
  const auto twice = bytes_of_all();
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_GT(once[i].size(), 500U) << names[i / 5];
    EXPECT_TRUE(once[i] == twice[i]) << names[i / 5] << ", file " << i % 5;
  }
  for (const auto& text : once)
    EXPECT_FALSE(text.find("%PDF") != 0 && has_not_a_number(std::regex_replace(text, std::regex("NaN"), "")));

  write_report(study);
  const auto page = read(folder.path / "report.html");
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_NE(page.find("data:image/svg+xml,%3csvg"), std::string::npos);
  EXPECT_EQ(page.find("Not drawn"), std::string::npos);
}

TEST(ReportFigures, OfAnEarlierStudyAreNotTakenForThisOnes) {
  NEEDS_GNUPLOT();
  const Folder folder;
  auto study = power_laws(folder.path);
  ASSERT_EQ(write_figures(study), "");
  auto& drift = study.runs[10].result.energy_drift_max_rel;
  drift = *drift * 1.01;
  write_report(study);  // without its figures
  const auto page = read(folder.path / "report.html");
  const auto at = page.find("Not drawn");
  EXPECT_NE(at, std::string::npos);
  EXPECT_EQ(page.find("Not drawn", at + 1), std::string::npos);  // the four other figures show this study

  for (auto& run : study.runs) run.result.attitude_error_max = std::nullopt;
  ASSERT_EQ(write_figures(study), "");
  EXPECT_FALSE(fs::exists(folder.path / "figures/error_against_step.svg"));
}

TEST(ReportFigures, WithoutGnuplotLeaveScriptsAndSayHowToGetIt) {
  const Folder folder;
  const auto study = power_laws(folder.path);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder.path.c_str(), 1);
  const auto text = write_figures(study);
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_NE(text.find("apt-get install gnuplot-nox"), std::string::npos) << text;
  EXPECT_NE(text.find("drift_against_step.gp"), std::string::npos) << text;
  EXPECT_TRUE(fs::exists(folder.path / "figures/drift_against_step.gp"));
  EXPECT_TRUE(fs::exists(folder.path / "figures/drift_against_step.dat"));
  EXPECT_FALSE(fs::exists(folder.path / "figures/drift_against_step.svg"));
}

TEST(ReportFigures, SayWhyGnuplotFailed) {
  const Folder folder;
  const auto study = power_laws(folder.path);
  std::ofstream(folder.path / "gnuplot") << "#!/bin/sh\necho 'no such terminal' >&2\nexit 3\n";
  fs::permissions(folder.path / "gnuplot", fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (folder.path.string() + ":" + path).c_str(), 1);
  std::string message;
  try {
    write_figures(study);
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_NE(message.find("exit status 3"), std::string::npos) << message;
  EXPECT_NE(message.find("no such terminal"), std::string::npos) << message;
}

}  // namespace
}  // namespace polhode::study::report_tests::figures_test
