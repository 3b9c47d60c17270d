// SPDX-License-Identifier: BSD-3-Clause
// The page of a made-up study: well-formed, escaped, and short.
#include "experiments/study/report/page/report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>

#include "experiments/study/report/figures/study_figures.hpp"
#include "experiments/study/report/tables/tables.hpp"
#include "experiments/study/text/notation.hpp"
#include "tests/experiments/study/report/made_up_study.hpp"
#include "tests/experiments/study/report/result_files.hpp"

namespace polhode::study::report_tests::report_test {
namespace {

TEST(Report, IsWellFormedAndOpensAlone) {
  const Folder folder;
  auto study = power_laws(folder.path);
  study.runs.front().result.energy_drift_max_rel = std::numeric_limits<double>::infinity();
  study.runs[1].result.attitude_error_max = std::nan("");
  write_report(study);
  const auto page = read(folder.path / "report.html");
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_FALSE(has_not_a_number(visible_text(page)));
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_NE(page.find(html(study.command)), std::string::npos);
  EXPECT_NE(page.find("the classical Runge-Kutta method"), std::string::npos);
  EXPECT_NE(page.find("Not drawn"), std::string::npos);  // no figures were made
}

TEST(Report, EscapesNames) {
  const Folder folder;
  const std::string name = "a&b <i>_x \"y\" 'z' `date` $1 50% {ü} #";
  auto study = power_laws(folder.path, name);
  study.question = study.command = name;
  study.scenarios.front().title = study.scenarios.front().description = name;
  study.varied_keys = {"body.0.<b>"};
  for (auto& run : study.runs) {
    run.config.varied = {{"body.0.<b>", "\"<\""}};
    if (run.config.integrator == "rk4") run.config.integrator = "my_<rk4>&'s";
  }
  study.runs.front().result.message = "<script>alert(1)</script>";
  write_tables(study);
  write_report(study);
  const auto page = read(folder.path / "report.html");
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_EQ(page.find("<i>"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("<b>_"), std::string::npos);
  EXPECT_NE(page.find("my_&lt;rk4&gt;&amp;&#39;s"), std::string::npos);
  EXPECT_NE(read(folder.path / "tables/summary.tex").find("my\\_\\textless{}rk4\\textgreater{}\\&'s"),
            std::string::npos);
  if (gnuplot_is_installed()) {
    EXPECT_EQ(write_figures(study), "");
    EXPECT_NE(read(folder.path / "figures/drift_against_step.svg").find("my_&lt;rk4>&amp;"), std::string::npos);
  }
}

TEST(Report, OfOneRunDescribesIt) {
  const Folder folder;
  auto study = empty_study(folder.path);
  study.experiment = "simulate";
  study.scenarios.push_back(fake_scenario("tumbling_box"));
  study.runs.push_back(fake_run(seven_methods[3], "tumbling_box", 0.01));
  write_tables(study);
  write_report(study);
  const auto page = read(folder.path / "report.html");
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_NE(visible_text(page).find("rk4 at dt = 0.01 s: the largest energy drift is 1.5e-10 (of an initial energy of "
                                    "368.546 J); the run loses energy"),
            std::string::npos);
  EXPECT_NE(page.find("the study has one step size only"), std::string::npos);
}

TEST(Report, OfRefusedRunsAloneGivesTheReasons) {
  const Folder folder;
  auto study = empty_study(folder.path);
  study.runs.push_back(fake_run(seven_methods[3], "top", 0.01));
  study.runs.front().result = RunResult{};
  study.runs.front().result.status = "refused";
  study.runs.front().result.message = "gyroscopic off makes no sense with the momentum state";
  EXPECT_EQ(write_figures(study), "");
  write_tables(study);
  write_report(study);
  const auto page = read(folder.path / "report.html");
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_NE(page.find("1 run: 1 refused."), std::string::npos);
  EXPECT_NE(page.find("gyroscopic off makes no sense with the momentum state"), std::string::npos);
}

TEST(Report, LeavesOutTheEmptyTimingOfResponsesThatAreForces) {
  const Folder folder;
  auto study = empty_study(folder.path);
  for (const auto& [response, timing] : {std::pair("compliant", ""), std::pair("single_impulse", "event_located")}) {
    study.runs.push_back(fake_run(seven_methods[3], "top", 0.01));
    study.runs.back().config.contact = {"sweep_and_prune", "sat", response, timing};
  }
  write_report(study);
  EXPECT_NE(read(folder.path / "report.html").find("<dt>timing of impacts</dt><dd>event_located</dd>"),
            std::string::npos);
  study.runs.pop_back();
  write_report(study);
  EXPECT_EQ(read(folder.path / "report.html").find("<dt>timing of impacts</dt>"), std::string::npos);
}

TEST(Report, OfThousandsOfRunsStaysShort) {
  const Folder folder;
  auto study = empty_study(folder.path);
  study.varied_keys = {"body.0.mass"};
  for (int i = 0; i < 500; ++i) {
    for (const double step : seven_steps) {
      study.runs.push_back(fake_run(seven_methods[3], "top", step));
      study.runs.back().config.varied = {{"body.0.mass", std::to_string(i)}};
      study.runs.back().result.series.clear();
    }
  }
  write_report(study);
  const auto page = read(folder.path / "report.html");
  EXPECT_LT(page.size(), 500000U);
  EXPECT_NE(page.find("The first 400 of 3500 runs"), std::string::npos);
}

}  // namespace
}  // namespace polhode::study::report_tests::report_test
