// SPDX-License-Identifier: BSD-3-Clause
// Made-up studies whose numbers are known: power laws of the step, round-off, runs that diverged.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/curves/error_ladder.hpp"
#include "experiments/study/record/study_view.hpp"

namespace polhode::study::report_tests {

namespace fs = std::filesystem;

inline const std::vector<double> seven_steps = {0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};
inline const std::vector<double> seven_tolerances = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};

/// The drifts of a made-up method: energy drift = scale · stepᵖ, attitude error likewise.
struct Law {
  std::string method;
  double scale = 1, p = 1;
  int sign = 1;
  bool adaptive = false;
  double diverges_above = std::numeric_limits<double>::infinity();
};

inline const std::vector<Law> seven_methods = {
    {.method = "explicit_euler", .scale = 12, .p = 1, .diverges_above = 0.06},
    {.method = "semi_implicit_euler", .scale = 3, .p = 1, .sign = -1},
    {.method = "explicit_midpoint", .scale = 8, .p = 3},
    {.method = "rk4", .scale = 1.5, .p = 5, .sign = -1},
    {.method = "cvode_adams", .scale = 30, .p = 1, .adaptive = true},
    {.method = "cvode_bdf", .scale = 200, .p = 0.9, .sign = -1, .adaptive = true},
    {.method = "odeint_dopri5", .scale = 3, .p = 1, .sign = -1, .adaptive = true},
};

inline std::vector<SeriesPoint> series_of(const RunResult& r, double t_end, double drift, int sign) {
  std::vector<SeriesPoint> series;
  for (int i = 0; i < 256 && i / 255.0 * t_end <= r.t_reached; ++i) {
    const double s = i / 255.0;
    const double wave = 1 + 0.3 * std::sin(40 * s);
    series.push_back({s * t_end, sign * drift * s * wave / 1.3, 0, r.angular_momentum_drift_max_rel.value_or(0) * s,
                      r.orientation_defect_max.value_or(0) * s});
  }
  return series;
}

inline RunRecord fake_run(const Law& law, const std::string& scenario, double step, double t_end = 10) {
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

inline Scenario fake_scenario(const std::string& name) {
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
  scenario.shapes.emplace_back();
  scenario.problem.forces.push_back(
      {.kind = "uniform_gravity", .bodies = {0}, .values = {{"acceleration", Vector3<double>(0, 0, -9.81)}}});
  return scenario;
}

inline StudyView empty_study(const fs::path& folder) {
  StudyView study;
  study.experiment = "energy_drift";
  study.question = "How does the energy drift depend on the method and the step?";
  study.command = "./run energy_drift --scenario tumbling_box --dt 1e-3:1e-1:7:log";
  study.folder = folder;
  return study;
}

/// Seven methods by seven steps or tolerances.
inline StudyView power_laws(const fs::path& folder, const std::string& scenario = "tumbling_box") {
  auto study = empty_study(folder);
  study.scenarios.push_back(fake_scenario(scenario));
  for (const auto& law : seven_methods) {
    for (const double step : law.adaptive ? seven_tolerances : seven_steps)
      study.runs.push_back(fake_run(law, scenario, step));
  }
  return study;
}

/// Two methods with the gyroscopic term and without it: without it the energy is kept and the momentum is not.
inline StudyView gyroscopic_study(const fs::path& folder) {
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

/// One method at 1/1280 s, 1/640 s, … with these attitude errors, smallest step first; where they are negative it
/// diverged.
inline StudyView with_attitude_errors(const std::string& method, const std::vector<double>& errors) {
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
inline std::optional<OrderEstimate::Line> attitude_line(const StudyView& study) {
  const auto grouping = group(study);
  return told_line(observed_order(grouping.curves.front(), quantity::attitude_error()));
}

// Errors that were measured on peters_hsu.
inline const std::vector<double> of_heun = {6.29e-3, 4.97e-2, 0.351, 0.600, 2.24, 2.61, 2.78, 0.971, 2.28};
inline const std::vector<double> of_crouch_grossman3 = {1.6e-3, 1.3e-2, 9.9e-2, 0.59, 3.0, 0.77, 2.2, 1.7, -1};
inline const std::vector<double> of_exact_rotor = {6.9e-10, 8.3e-11, 2.5e-10, 1.2e-10, 6.0e-11,
                                                   1.6e-11, 2.1e-11, 2.1e-11, 2.3e-11};
inline const std::vector<double> of_recipe_bullet = {0.26, 0.52, 1.0, 2.0, 2.5, 0.61, 0.83, 0.75, 0.85};

}  // namespace polhode::study::report_tests
