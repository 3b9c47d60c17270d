// SPDX-License-Identifier: BSD-3-Clause
// The sentences that a report draws from the runs of a made-up study.
#include "experiments/study/report/findings/findings.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "tests/experiments/study/report/made_up_study.hpp"

namespace polhode::study::report_tests::findings_test {
namespace {

std::string findings_text(const StudyView& study) {
  const auto findings = findings_of(study, group(study));
  std::string text = findings.outcome + "\n";
  for (const auto& caution : findings.cautions) text += caution + "\n";
  for (const auto& topic : findings.topics) {
    for (const auto& sentence : topic.sentences) text += sentence + "\n";
  }
  return text;
}

TEST(ReportFindings, SayWhyTheDataDoNotTellAnOrder) {
  const auto about = [](const std::string& method, const std::vector<double>& errors) {
    return findings_text(with_attitude_errors(method, errors));
  };
  EXPECT_NE(about("exact_rotor", of_exact_rotor)
                .find("The data do not tell the order of the attitude error of exact_rotor: errors at round-off."),
            std::string::npos);
  EXPECT_NE(about("recipe_bullet", of_recipe_bullet)
                .find("The data do not tell the order of the attitude error of recipe_bullet: steps too large: the "
                      "attitude is off by "
                      "more than half a radian."),
            std::string::npos)
      << about("recipe_bullet", of_recipe_bullet);
  EXPECT_NE(about("heun", of_heun).find("order of the attitude error of heun: too few points for a line within ±0.5."),
            std::string::npos)
      << about("heun", of_heun);
  EXPECT_NE(about("crouch_grossman3", of_crouch_grossman3)
                .find("the attitude error falls at least as fast as the declared order"),
            std::string::npos);
  for (const auto& [method, errors] :
       {std::pair("exact_rotor", of_exact_rotor), std::pair("recipe_bullet", of_recipe_bullet),
        std::pair("heun", of_heun), std::pair("crouch_grossman3", of_crouch_grossman3)}) {
    EXPECT_EQ(about(method, errors).find("the attitude error falls more slowly"), std::string::npos)
        << about(method, errors);
  }
  // A slower fall is still reported.
  EXPECT_NE(about("rk4", {1e-6, 4e-6, 1.6e-5, 6.4e-5, 2.56e-4})
                .find("falls more slowly than the declared order for rk4 (2.00 over 5 points"),
            std::string::npos);
}

TEST(ReportFindings, NameNoLeastAmongRunsThatDoNotFollowTheMotion) {
  auto study = with_attitude_errors("rk4", {3.04, 2.2, 2.6});
  for (const auto& run : with_attitude_errors("heun", {3.1, 2.9, 1.2}).runs) study.runs.push_back(run);
  auto text = findings_text(study);
  EXPECT_EQ(text.find("least attitude error"), std::string::npos) << text;
  EXPECT_NE(text.find("no run follows the motion: the attitude of rk4 and heun is off by more than a radian"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("No run follows the motion of top: all 6 that ended are off by more than a radian"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("follows the motion"), text.find("follows the motion of top")) << "the caution comes first";

  // One that follows is the least, and those that do not are named, not ranked.
  for (const auto& run : with_attitude_errors("explicit_midpoint", {0.1, 0.2, 0.4}).runs) study.runs.push_back(run);
  for (const auto& run : with_attitude_errors("gauss4", {0.3, 0.4, 0.7}).runs) study.runs.push_back(run);
  text = findings_text(study);
  EXPECT_EQ(text.find("No run follows"), std::string::npos) << text;
  EXPECT_NE(text.find("explicit_midpoint has the least attitude error (0.1 rad) and gauss4 the most (0.3 rad); the "
                      "attitude of rk4 and "
                      "heun is off by more than a radian."),
            std::string::npos)
      << text;
}

TEST(ReportFindings, PraiseNoDriftOfARunThatDoesNotFollowTheMotion) {
  auto study = with_attitude_errors("rk4", {2.2, 2.3, 2.4});
  for (auto& run : study.runs) run.result.energy_drift_max_rel = 1e-6;
  for (const auto& run : with_attitude_errors("heun", {0.1, 0.2, 0.4}).runs) study.runs.push_back(run);
  for (auto& run : study.runs) {
    if (run.config.integrator == "heun") run.result.energy_drift_max_rel = 1e-3;
  }
  const auto text = findings_text(study);
  EXPECT_NE(
      text.find("rk4 has the least energy drift (1e-6, but does not follow the motion) and heun the most (0.001)"),
      std::string::npos)
      << text;
  for (auto& run : study.runs) run.result.energy_drift_max_rel = run.config.integrator == "rk4" ? 7 : 5;
  const auto lost = findings_text(study);
  EXPECT_EQ(lost.find("least energy drift"), std::string::npos) << lost;
  EXPECT_NE(lost.find("no run keeps it: the energy drift of heun and rk4 is 1 or more, of rk4 the most (7)"),
            std::string::npos)
      << lost;
}

TEST(ReportFindings, SayWhoDriftsLeastAndMostAndWhoDiverged) {
  const auto text = findings_text(power_laws("unused"));
  EXPECT_NE(text.find("49 runs: 48 completed and 1 diverged."), std::string::npos) << text;
  EXPECT_NE(text.find("At dt = 0.1 s, the largest step: rk4 has the least energy drift (1.5e-5) and "
                      "semi_implicit_euler the most (0.3); "
                      "explicit_euler did not reach the end."),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("At dt = 0.001 s, the smallest step: the energy drift of rk4 is at round-off (at most 1.7e-15); "
                      "explicit_euler has "
                      "the most (0.012)."),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("At tolerance = 1e-10, the tightest: odeint_dopri5 has the least"), std::string::npos) << text;
  EXPECT_NE(text.find("explicit_euler diverged in 1 of 7 runs; it did so, at dt = 0.1 s, at t = 4 s."),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("gained by explicit_euler, explicit_midpoint and cvode_adams; lost by semi_implicit_euler, rk4"),
            std::string::npos)
      << text;
}

TEST(ReportFindings, SayWhereADriftFallsMoreSlowlyThanDeclared) {
  auto study = empty_study("unused");
  for (const double step : seven_steps)
    study.runs.push_back(fake_run({.method = "rk4", .scale = 1, .p = 2}, "top", step));
  EXPECT_NE(findings_text(study).find(
                "falls more slowly than the declared order for rk4 (2.00 over 7 points, declared order 4)"),
            std::string::npos)
      << findings_text(study);
}

TEST(ReportFindings, SayThatEnergyAloneWouldHideAMissingGyroscopicTerm) {
  const auto text = findings_text(gyroscopic_study("unused"));
  EXPECT_NE(text.find("tumbling_box, gyroscopic off: energy alone would call these runs perfect (14 runs of "
                      "semi_implicit_euler and rk4)"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("the angular momentum drifts by 0.0325 at every step size"), std::string::npos) << text;
  EXPECT_NE(text.find("missing gyroscopic term"), std::string::npos) << text;

  const auto study = gyroscopic_study("unused");
  const auto findings = findings_of(study, group(study));
  const auto topic = std::find_if(findings.topics.begin(), findings.topics.end(),
                                  [](const auto& t) { return t.heading == "With and without the gyroscopic term"; });
  ASSERT_NE(topic, findings.topics.end());
  ASSERT_EQ(topic->tables.front().rows.size(), 2U);  // one for each method
  EXPECT_EQ(topic->tables.front().rows[1][6], "0.0325");
}

TEST(ReportFindings, SayItToWhereAllRunsLeaveTheTermOut) {
  auto study = gyroscopic_study("unused");
  std::erase_if(study.runs, [](const auto& run) { return run.config.formulation.gyroscopic; });
  EXPECT_NE(findings_text(study).find("tumbling_box, gyroscopic off: energy alone"), std::string::npos)
      << findings_text(study);
  for (auto& run : study.runs) run.result.angular_momentum_drift_max_rel = std::nullopt;
  const auto text = findings_text(study);
  EXPECT_NE(text.find("14 runs leave the gyroscopic term out, and the forces do not conserve the angular momentum"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("in every one of these runs: the attitude error (at least 0.7 rad)."), std::string::npos) << text;
}

TEST(ReportFindings, DoNotCryWolf) {
  const auto study = power_laws("unused");
  EXPECT_TRUE(findings_of(study, group(study)).cautions.empty());
}

TEST(ReportFindings, ExplainEmptyColumns) {
  auto study = power_laws("unused");
  for (auto& run : study.runs) run.result.attitude_error_max = std::nullopt;
  const auto text = findings_text(study);
  EXPECT_NE(text.find("No exact solution is known for tumbling_box"), std::string::npos) << text;
  EXPECT_NE(
      text.find("In tumbling_box the linear momentum is no invariant: the forces (uniform_gravity) do not conserve it"),
      std::string::npos)
      << text;
}

TEST(ReportFindings, CountOverManyMotions) {
  auto study = empty_study("unused");
  study.varied_keys = {"body.0.mass"};
  for (int i = 0; i < 20; ++i) {
    for (const auto& law : {seven_methods[0], seven_methods[3]}) {
      for (const double step : {0.01, 0.001}) {
        study.runs.push_back(fake_run(law, "top", step));
        study.runs.back().config.varied = {{"body.0.mass", std::to_string(i)}};
      }
    }
  }
  const auto text = findings_text(study);
  EXPECT_NE(text.find("Least energy drift, or at round-off, counted over motions and formulations: at the largest step "
                      "rk4 (all 20); at "
                      "the smallest step rk4 (all 20)."),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("Most energy drift: at the largest step explicit_euler (all 20)"), std::string::npos) << text;
}

}  // namespace
}  // namespace polhode::study::report_tests::findings_test
