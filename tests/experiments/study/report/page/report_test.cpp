// SPDX-License-Identifier: BSD-3-Clause
// Figures, tables and the report of made-up studies whose numbers are known: power laws of the step, round-off, zeros,
// runs that diverged, names that need escaping.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/curves/error_ladder.hpp"
#include "experiments/study/plot/axis.hpp"
#include "experiments/study/record/study_view.hpp"
#include "experiments/study/report/figures/study_figures.hpp"
#include "experiments/study/report/findings/findings.hpp"
#include "experiments/study/report/tables/tex_values.hpp"
#include "experiments/study/text/notation.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study {
namespace {

namespace fs = std::filesystem;

const std::vector<double> seven_steps = {0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};
const std::vector<double> seven_tolerances = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};

/// How a made-up method drifts: energy drift = scale · stepᵖ, attitude error likewise.
struct Law {
  std::string method;
  double scale = 1, p = 1;
  int sign = 1;
  bool adaptive = false;
  double diverges_above = std::numeric_limits<double>::infinity();
};

const std::vector<Law> seven_methods = {
    {.method = "explicit_euler", .scale = 12, .p = 1, .diverges_above = 0.06},
    {.method = "semi_implicit_euler", .scale = 3, .p = 1, .sign = -1},
    {.method = "explicit_midpoint", .scale = 8, .p = 3},
    {.method = "rk4", .scale = 1.5, .p = 5, .sign = -1},
    {.method = "cvode_adams", .scale = 30, .p = 1, .adaptive = true},
    {.method = "cvode_bdf", .scale = 200, .p = 0.9, .sign = -1, .adaptive = true},
    {.method = "odeint_dopri5", .scale = 3, .p = 1, .sign = -1, .adaptive = true},
};

std::vector<SeriesPoint> series_of(const RunResult& r, double t_end, double drift, int sign) {
  std::vector<SeriesPoint> series;
  for (int i = 0; i < 256 && i / 255.0 * t_end <= r.t_reached; ++i) {
    const double s = i / 255.0;
    const double wave = 1 + 0.3 * std::sin(40 * s);
    series.push_back({s * t_end, sign * drift * s * wave / 1.3, 0, r.angular_momentum_drift_max_rel.value_or(0) * s,
                      r.orientation_defect_max.value_or(0) * s});
  }
  return series;
}

RunRecord fake_run(const Law& law, const std::string& scenario, double step, double t_end = 10) {
  static int next_id = 1;
  RunRecord run;
  run.id = fmt::format("{:016x}", next_id++);
  run.config.scenario = scenario;
  run.config.integrator = law.method;
  run.config.t_end = t_end;
  (law.adaptive ? run.config.tolerance : run.config.dt) = step;

  auto& r = run.result;
  const double round_off = 2e-16;
  const double drift = law.scale * std::pow(step, law.p);
  const bool diverged = step > law.diverges_above;
  r.status = diverged ? "diverged" : "ok";
  r.message = diverged ? "the energy drift passed 1e6" : "";
  r.t_reached = diverged ? 0.4 * t_end : t_end;
  r.steps = static_cast<std::int64_t>(law.adaptive ? 200 * std::pow(1e-4 / step, 0.2) : t_end / step);
  r.evaluations = 4 * r.steps;
  r.energy_initial = 368.546416625;
  r.energy_drift_max_rel = diverged ? 1e6 : drift + round_off;
  r.energy_drift_final_rel = law.sign * *r.energy_drift_max_rel;
  r.energy_drift_rate = law.sign * drift * 368.5 / t_end;
  r.drift_class = diverged ? "" : "linear";
  r.angular_momentum_drift_max_rel = 0.3 * drift + round_off;
  r.orientation_defect_max = law.adaptive ? 0.01 * drift : 0.1 * drift + round_off;
  r.attitude_error_max = std::min(3.1, 2 * drift);
  r.series = series_of(r, t_end, diverged ? 900 : drift, law.sign);
  return run;
}

Scenario fake_scenario(const std::string& name) {
  Scenario scenario;
  scenario.name = name;
  scenario.title = "Tumbling box";
  scenario.description = "A box thrown spinning about its intermediate axis.";
  scenario.t_end = 10;
  Body box;
  box.name = "box";
  box.mass = 10;
  scenario.problem.bodies.push_back(box);
  scenario.problem.starts.emplace_back();
  scenario.problem.forces.push_back({.kind = "uniform_gravity", .bodies = {0}, .values = {}});
  return scenario;
}

/// A folder of the test's own, gone with it; its name needs quoting wherever it is not.
struct Folder : TemporaryFolder {
  fs::path path = TemporaryFolder::path() / "it's ü \"quoted\"";
  Folder() { fs::create_directory(path); }
};

StudyView empty_study(const fs::path& folder) {
  StudyView study;
  study.experiment = "energy_drift";
  study.question = "How does the energy drift depend on the method and the step?";
  study.command = "./run energy_drift --scenario tumbling_box --dt 1e-3:1e-1:7:log";
  study.folder = folder;
  return study;
}

/// Seven methods by seven steps or tolerances.
StudyView power_laws(const fs::path& folder, const std::string& scenario = "tumbling_box") {
  auto study = empty_study(folder);
  study.scenarios.push_back(fake_scenario(scenario));
  for (const auto& law : seven_methods) {
    for (const double step : law.adaptive ? seven_tolerances : seven_steps)
      study.runs.push_back(fake_run(law, scenario, step));
  }
  return study;
}

/// Two methods with the gyroscopic term and without it: without it the energy is kept and the momentum is not.
StudyView gyroscopic_study(const fs::path& folder) {
  auto study = empty_study(folder);
  study.scenarios.push_back(fake_scenario("tumbling_box"));
  for (const bool gyroscopic : {true, false}) {
    for (const auto& law : {seven_methods[1], seven_methods[3]}) {
      for (const double step : seven_steps) {
        auto run = fake_run(law, "tumbling_box", step);
        run.config.formulation.gyroscopic = gyroscopic;
        if (!gyroscopic) {
          run.result.energy_drift_max_rel = 2.5e-15;
          run.result.energy_drift_final_rel = 1e-15;
          run.result.angular_momentum_drift_max_rel = 0.0325276;
          run.result.attitude_error_max = 0.7;
        }
        study.runs.push_back(run);
      }
    }
  }
  return study;
}

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

bool gnuplot_is_installed() { return std::system("command -v gnuplot >/dev/null 2>&1") == 0; }

#define NEEDS_GNUPLOT() \
  if (!gnuplot_is_installed()) GTEST_SKIP() << "skipped, because gnuplot is not installed"

/// What a reader sees of a page, without tags and style.
std::string visible_text(const std::string& page) {
  const auto body = page.substr(page.find("<body>"));
  return std::regex_replace(std::regex_replace(body, std::regex("</?span[^>]*>"), ""), std::regex("<[^>]*>"), " ");
}

/// Empty if every tag that is opened is closed in order; otherwise what is wrong.
std::string unbalanced(const std::string& page) {
  static const std::set<std::string> no_end = {"meta", "img", "br", "!doctype"};
  std::vector<std::string> open;
  for (std::size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at + 1)) {
    const bool closes = page[at + 1] == '/';
    std::string tag;
    for (std::size_t i = at + 1 + closes;
         i < page.size() && (std::isalnum(static_cast<unsigned char>(page[i])) || page[i] == '!'); ++i) {
      tag += static_cast<char>(std::tolower(static_cast<unsigned char>(page[i])));
    }
    if (tag.empty()) return "a stray < at " + page.substr(at, 40);
    if (no_end.contains(tag)) continue;
    if (!closes) {
      open.push_back(tag);
      if (tag == "style") at = page.find("</style>", at) - 1;
    } else if (open.empty() || open.back() != tag) {
      return "</" + tag + "> closes " + (open.empty() ? "nothing" : open.back());
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back() + " is never closed";
}

/// NaN and infinities as C and C++ print them, as words of their own.
bool has_not_a_number(const std::string& text) {
  return std::regex_search(text, std::regex("(^|[^A-Za-z])-?(nan|inf|infinity)([^A-Za-z]|$)", std::regex::icase));
}

std::string findings_text(const StudyView& study) {
  const auto findings = report::findings_of(study, report::group(study));
  std::string text = findings.outcome + "\n";
  for (const auto& caution : findings.cautions) text += caution + "\n";
  for (const auto& topic : findings.topics) {
    for (const auto& sentence : topic.sentences) text += sentence + "\n";
  }
  return text;
}

const report::Figure* find_figure(const report::FigureSet& set, const std::string& name) {
  const auto at = std::find_if(set.figures.begin(), set.figures.end(), [&](const auto& f) { return f.name == name; });
  return at == set.figures.end() ? nullptr : &*at;
}

std::vector<report::Point> points_with(const report::Figure& figure, report::Mark mark) {
  std::vector<report::Point> found;
  for (const auto& panel : figure.panels) {
    for (const auto& curve : panel.curves) {
      std::copy_if(curve.points.begin(), curve.points.end(), std::back_inserter(found),
                   [&](const auto& p) { return p.mark == mark; });
    }
  }
  return found;
}

TEST(ReportNotation, PrintsNumbersShortly) {
  EXPECT_EQ(report::number(0.0325276), "0.0325");
  EXPECT_EQ(report::number(3.25e-5), "3.25e-5");
  EXPECT_EQ(report::number(-1e6), "-1e6");
  EXPECT_EQ(report::number(1234.6), "1235");
  EXPECT_EQ(report::number(1e-10), "1e-10");
  EXPECT_EQ(report::number(std::nan("")), "not finite");
  EXPECT_EQ(report::exact(0.001), "0.001");
  EXPECT_EQ(report::exact(1e-5), "1e-5");
  EXPECT_EQ(report::exact(1.0 / 3), "0.3333333333333333");
  EXPECT_EQ(report::tex_number("3.25e-5"), "$3.25\\times10^{-5}$");
  EXPECT_EQ(report::tex_number("1e-5"), "$10^{-5}$");
}

TEST(ReportNotation, EscapesWhatEachFormatWouldRead) {
  EXPECT_EQ(report::html("a & b < \"c\""), "a &amp; b &lt; &quot;c&quot;");
  EXPECT_EQ(report::tex("a_b & 50% {x} ^2 \\y"), "a\\_b \\& 50\\% \\{x\\} \\textasciicircum{}2 \\textbackslash{}y");
  EXPECT_EQ(report::gnuplot("it's `date`\n"), "'it''s `date` '");
  EXPECT_EQ(report::markdown("a|b_c"), "a\\|b\\_c");
  EXPECT_EQ(report::shortened("größe", 5), "größe");
  EXPECT_EQ(report::shortened("größere", 4), "grö…");
  EXPECT_EQ(report::base64("Man"), "TWFu");
  EXPECT_EQ(report::base64("Ma"), "TWE=");
  EXPECT_EQ(report::base64("M"), "TQ==");
}

TEST(ReportCurves, FindTheSlopesOfPowerLaws) {
  const auto study = power_laws("unused");
  const auto grouping = report::group(study);
  ASSERT_EQ(grouping.curves.size(), seven_methods.size());
  for (const auto& curve : grouping.curves) {
    const auto& method = grouping.methods[curve.method_index];
    const auto& law =
        *std::find_if(seven_methods.begin(), seven_methods.end(), [&](const auto& l) { return l.method == method; });
    const auto line = report::told_line(report::observed_order(curve, report::quantity::energy_drift()));
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
  const auto grouping = report::group(study);
  const auto order = report::observed_order(grouping.curves.front(), report::quantity::energy_drift());
  ASSERT_TRUE(order.line);
  EXPECT_EQ(order.points, 3U);
  EXPECT_EQ(order.blown_up, 2U);
  EXPECT_EQ(order.at_round_off, 2U);
  EXPECT_NEAR(order.line->order, 4, 1e-3);
}

/// One method at 1/1280 s, 1/640 s, … with these attitude errors, smallest step first; where they are negative it
/// diverged.
StudyView with_attitude_errors(const std::string& method, const std::vector<double>& errors) {
  auto study = empty_study("unused");
  study.scenarios.push_back(fake_scenario("top"));
  double step = 1.0 / 1280;
  for (const double error : errors) {
    auto run = fake_run({.method = method, .scale = 1e-3, .p = 4}, "top", step);
    run.result.attitude_error_max = error;
    if (error < 0) run.result.status = "diverged", run.result.attitude_error_max = std::nullopt;
    study.runs.push_back(run);
    step *= 2;
  }
  return study;
}
std::optional<OrderEstimate::Line> attitude_line(const StudyView& study) {
  const auto grouping = report::group(study);
  return report::told_line(report::observed_order(grouping.curves.front(), report::quantity::attitude_error()));
}

// As they were measured on peters_hsu.
const std::vector<double> of_heun = {6.29e-3, 4.97e-2, 0.351, 0.600, 2.24, 2.61, 2.78, 0.971, 2.28};
const std::vector<double> of_crouch_grossman3 = {1.6e-3, 1.3e-2, 9.9e-2, 0.59, 3.0, 0.77, 2.2, 1.7, -1};
const std::vector<double> of_exact_rotor = {6.9e-10, 8.3e-11, 2.5e-10, 1.2e-10, 6.0e-11,
                                            1.6e-11, 2.1e-11, 2.1e-11, 2.3e-11};
const std::vector<double> of_recipe_bullet = {0.26, 0.52, 1.0, 2.0, 2.5, 0.61, 0.83, 0.75, 0.85};

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
  // Of what does fall more slowly it is still said.
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

TEST(ReportCurves, LeaveOutOfASlopeTheFloorThatRoundingMakes) {
  auto study = empty_study("unused");
  const std::vector<double> drifts = {1.3e-6,  4.64e-8,  1.64e-9, 6.36e-11,
                                      1.5e-11, 1.66e-11, 6.19e-11};  // rk4 on a thrown box
  const std::vector<double> steps = {0.04, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    study.runs.push_back(fake_run({.method = "rk4"}, "top", steps[i]));
    study.runs.back().result.energy_drift_max_rel = drifts[i];
  }
  // What is less than ten times the floor has rounding in it.
  const auto order = report::observed_order(report::group(study).curves.front(), report::quantity::energy_drift());
  ASSERT_TRUE(report::told_line(order));
  EXPECT_EQ(order.points, 3U);
  EXPECT_NEAR(order.line->order, 4.82, 0.05);

  // A plateau that is no round-off counts.
  for (auto& run : study.runs) run.result.energy_drift_max_rel = 0.0325;
  const auto flat = report::observed_order(report::group(study).curves.front(), report::quantity::energy_drift());
  ASSERT_TRUE(report::told_line(flat));
  EXPECT_EQ(flat.points, 7U);
  EXPECT_NEAR(flat.line->order, 0, 1e-12);
}

TEST(ReportCurves, StandInTheCataloguesOrderWhateverTheOrderOfTheRuns) {
  auto study = power_laws("unused");
  std::reverse(study.runs.begin(), study.runs.end());
  const auto grouping = report::group(study);
  ASSERT_EQ(grouping.methods.size(), seven_methods.size());
  for (std::size_t i = 0; i < seven_methods.size(); ++i) EXPECT_EQ(grouping.methods[i], seven_methods[i].method);
  for (const auto& curve : grouping.curves)
    EXPECT_GT(*report::abscissa(*curve.runs.front()), *report::abscissa(*curve.runs.back()));
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
  const auto findings = report::findings_of(study, report::group(study));
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
  EXPECT_TRUE(report::findings_of(study, report::group(study)).cautions.empty());
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

TEST(ReportFigures, KeepZeroDriftAndDivergedRunsInSight) {
  auto study = power_laws("unused");
  for (auto& run : study.runs) {
    if (run.config.integrator == "rk4") run.result.energy_drift_max_rel = 0;
  }
  // Whatever a diverged run measured before it ended is no result.
  study.runs.front().result.energy_drift_max_rel = 0.5;
  const auto set = report::figures_of(study, report::group(study));
  const auto* figure = find_figure(set, "drift_against_step");
  ASSERT_NE(figure, nullptr);
  const auto zeros = points_with(*figure, report::Mark::zero), edges = points_with(*figure, report::Mark::edge);
  ASSERT_EQ(zeros.size(), 7U);
  ASSERT_EQ(edges.size(), 1U);
  const auto& axis = figure->panels.front().y;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const auto& point : points_with(*figure, report::Mark::value)) {
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
  const auto set = report::figures_of(study, report::group(study));
  EXPECT_EQ(points_with(*find_figure(set, "drift_against_step"), report::Mark::edge).size(), 7U);
}

TEST(ReportFigures, DrawAllPointsInsideTheirAxes) {
  const auto study = power_laws("unused");
  for (const auto& figure : report::figures_of(study, report::group(study)).figures) {
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
  const auto set = report::figures_of(study, report::group(study));
  EXPECT_EQ(find_figure(set, "error_against_step"), nullptr);
  ASSERT_EQ(set.absent.size(), 1U);
  EXPECT_EQ(set.absent.front().name, "error_against_step");
  EXPECT_NE(set.absent.front().reason.find("exact solution"), std::string::npos);
}

TEST(ReportFigures, OfOneRunAreAgainstTime) {
  auto study = empty_study("unused");
  study.runs.push_back(fake_run(seven_methods[3], "top", 0.01));
  const auto set = report::figures_of(study, report::group(study));
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
  const auto set = report::figures_of(study, report::group(study));
  const auto* figure = find_figure(set, "drift_against_step");
  ASSERT_NE(figure, nullptr);
  EXPECT_EQ(figure->panels.size(), 4U);
  EXPECT_EQ(figure->panels.front().title.back(), "body.0.mass = 0");
  EXPECT_EQ(figure->panels.back().title.back(), "body.0.mass = 8");
  EXPECT_NE(figure->caption.find("4 of 9 cases"), std::string::npos) << figure->caption;
}

TEST(ReportAxis, SymlogGoesThereAndBack) {
  const auto axis = report::symlog_axis("y", -1e-3, 1e2, 1e-9);
  EXPECT_DOUBLE_EQ(axis.threshold, 1e-11);
  for (const double y : {-1e-3, -1e-12, 0.0, 1e-11, 3e-5, 99.0})
    EXPECT_NEAR(axis.value_at(axis.place(y)), y, 1e-12 * std::abs(y));
  EXPECT_LT(axis.low, -1e-3);
  EXPECT_GT(axis.high, 1e2);
  EXPECT_LE(axis.ticks.size(), 12U);
}

TEST(ReportTables, NameRunsInLettersAndNoTwoAlike) {
  auto study = power_laws("unused");
  const auto names = report::tex_names(study);
  EXPECT_EQ(names[3 * 7 + 6], "polhodeTumblingBoxRkFourDtOneEMinusThree");
  EXPECT_EQ(names[4 * 7], "polhodeTumblingBoxCvodeAdamsToleranceOneEMinusFour");
  study.runs.push_back(study.runs.front());
  study.runs.back().id = "00000000000000ff";
  const auto more = report::tex_names(study);
  EXPECT_EQ(std::set<std::string>(more.begin(), more.end()).size(), study.runs.size());
  for (const auto& name : more)
    EXPECT_TRUE(std::all_of(name.begin(), name.end(), [](char c) { return std::isalpha(c); })) << name;
}

TEST(ReportTables, AreWritten) {
  const Folder folder;
  auto study = power_laws(folder.path);
  study.runs.front().result.energy_drift_max_rel = std::numeric_limits<double>::infinity();
  study.runs[1].result.attitude_error_max = std::nan("");
  write_tables(study);
  const auto tex = read(folder.path / "tables/summary.tex"), md = read(folder.path / "tables/summary.md");
  const auto values = read(folder.path / "tables/values.tex");
  EXPECT_NE(tex.find("\\begin{longtable}"), std::string::npos);  // 49 rows
  EXPECT_NE(tex.find("\\texttt{semi\\_implicit\\_euler}"), std::string::npos);
  EXPECT_NE(tex.find("\\toprule"), std::string::npos);
  EXPECT_NE(md.find("| rk4 | 0.1 |"), std::string::npos) << md;
  EXPECT_NE(
      values.find(
          "\\newcommand{\\polhodeTumblingBoxRkFourDtOneEMinusOneEnergyDriftMax}{\\ensuremath{1.5\\times10^{-5}}}"),
      std::string::npos);
  EXPECT_NE(values.find("\\newcommand{\\polhodeTumblingBoxRkFourEnergyDriftSlope}"), std::string::npos);
  for (const auto& text : {tex, md, values}) EXPECT_FALSE(has_not_a_number(text));

  study.runs.resize(3);
  write_tables(study);
  EXPECT_NE(read(folder.path / "tables/summary.tex").find("\\begin{tabular}"), std::string::npos);
}

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
  EXPECT_NE(page.find(report::html(study.command)), std::string::npos);
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
  EXPECT_NE(page.find("data:image/svg+xml;base64,"), std::string::npos);
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
}  // namespace polhode::study
