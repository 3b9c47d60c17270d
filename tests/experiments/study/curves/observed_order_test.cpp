// SPDX-License-Identifier: BSD-3-Clause
// The observed order of error against step: what is fitted and what is left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/curves/error_ladder.hpp"
#include "tests/experiments/study/report/made_up_study.hpp"

namespace polhode::study::report_tests::observed_order_test {
namespace {

TEST(ReportCurves, FindTheSlopesOfPowerLaws) {
  const auto study = power_laws("unused");
  const auto grouping = group(study);
  ASSERT_EQ(grouping.curves.size(), seven_methods.size());
  for (const auto& curve : grouping.curves) {
    const auto& method = grouping.methods[curve.method_index];
    const auto& law =
        *std::find_if(seven_methods.begin(), seven_methods.end(), [&](const auto& l) { return l.method == method; });
    const auto line = told_line(observed_order(curve, quantity::energy_drift()));
    ASSERT_TRUE(line) << method;
    EXPECT_NEAR(line->order, law.p, 0.02) << method;
  }
}

TEST(ReportCurves, LeaveOutOfASlopeWhatIsRoundOffSaturatedOrDiverged) {
  auto study = empty_study("unused");
  const Law law{.method = "rk4", .scale = 1, .p = 4, .diverges_above = 0.06};
  for (const double step : seven_steps) study.runs.push_back(fake_run(law, "top", step));  // 0.1 diverged
  study.runs[1].result.energy_drift_max_rel = 20;                                          // 0.05 saturated
  study.runs[5].result.energy_drift_max_rel = 0;                                           // 0.002 exactly zero
  study.runs[6].result.energy_drift_max_rel = 1e-14;  // 0.001 round-off of 10000 steps
  const auto grouping = group(study);
  const auto order = observed_order(grouping.curves.front(), quantity::energy_drift());
  ASSERT_TRUE(order.line);
  EXPECT_EQ(order.points, 3U);
  EXPECT_EQ(order.blown_up, 2U);
  EXPECT_EQ(order.at_round_off, 2U);
  EXPECT_NEAR(order.line->order, 4, 1e-3);
}

TEST(ReportCurves, FitNoOrderToWrappedAngles) {
  EXPECT_FALSE(attitude_line(with_attitude_errors("heun", of_heun))) << "three points, which rise by 2.98 and 2.82";
  EXPECT_FALSE(attitude_line(with_attitude_errors("recipe_bullet", of_recipe_bullet)));
  const auto line = attitude_line(with_attitude_errors("crouch_grossman3", of_crouch_grossman3));
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->order, 3, 0.05);
  // An angle that is small by chance at a step beyond one that is lost.
  EXPECT_FALSE(attitude_line(with_attitude_errors("rk4", {0.2, 0.4, 2.1, 0.02, 0.2, 0.3})));
}

TEST(ReportCurves, FitNoOrderToRounding) {
  EXPECT_FALSE(attitude_line(with_attitude_errors("exact_rotor", of_exact_rotor)));
}

TEST(ReportCurves, LeaveOutOfASlopeTheFloorThatRoundingMakes) {
  auto study = empty_study("unused");
  const std::vector<double> drifts = {1.3e-6,  4.64e-8,  1.64e-9, 6.36e-11,
                                      1.5e-11, 1.66e-11, 6.19e-11};  // rk4 on a thrown box
  const std::vector<double> steps = {0.04, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    study.runs.push_back(fake_run({.method = "rk4"}, "top", steps[i]));
    study.runs.back().result.energy_drift_max_rel = drifts[i];
  }
  // Errors of less than ten times the floor have rounding in them.
  const auto order = observed_order(group(study).curves.front(), quantity::energy_drift());
  ASSERT_TRUE(told_line(order));
  EXPECT_EQ(order.points, 3U);
  EXPECT_NEAR(order.line->order, 4.82, 0.05);

  // A plateau that is no round-off counts.
  for (auto& run : study.runs) run.result.energy_drift_max_rel = 0.0325;
  const auto flat = observed_order(group(study).curves.front(), quantity::energy_drift());
  ASSERT_TRUE(told_line(flat));
  EXPECT_EQ(flat.points, 7U);
  EXPECT_NEAR(flat.line->order, 0, 1e-12);
}

TEST(ReportCurves, StandInTheCataloguesOrderWhateverTheOrderOfTheRuns) {
  auto study = power_laws("unused");
  std::reverse(study.runs.begin(), study.runs.end());
  const auto grouping = group(study);
  ASSERT_EQ(grouping.methods.size(), seven_methods.size());
  for (std::size_t i = 0; i < seven_methods.size(); ++i) EXPECT_EQ(grouping.methods[i], seven_methods[i].method);
  for (const auto& curve : grouping.curves) EXPECT_GT(*abscissa(*curve.runs.front()), *abscissa(*curve.runs.back()));
}

}  // namespace
}  // namespace polhode::study::report_tests::observed_order_test
