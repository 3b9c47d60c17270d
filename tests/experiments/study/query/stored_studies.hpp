// SPDX-License-Identifier: BSD-3-Clause
// Small studies in stores, for tests of those who read them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/run_record.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/store/store.hpp"

namespace polhode::study::query_tests {

constexpr const char* top = R"(t_end = 1
gravity = [0, 0, -9.81]
[[body]]
name = "top"
mass = 1.5
inertia = [1, 2, 3]
angular_velocity = [0.1, 2, 0.3]
)";

/// A run of the scenario whose file is NAME.toml with this text; `result` is left for the caller.
inline RunRecord run_of(const std::string& text, const RunConfig& config) {
  const ScenarioSource source = ScenarioSource::parse(text, config.scenario + ".toml");
  RunRecord run{.id = {}, .config = config, .result = {}};
  run.scenario = std::make_shared<const Scenario>(source.resolve(config.varied));
  run.id = run_id(config, run.scenario->canonical());
  run.result.status = "ok";
  return run;
}

/// Keeps the run and its scenario in the store of a folder.
inline void keep_in(const std::filesystem::path& folder, const std::string& text, const RunRecord& run) {
  std::filesystem::create_directories(folder);
  Store store(folder);
  const Scenario scenario = ScenarioSource::parse(text, run.config.scenario + ".toml").resolve();
  store.keep_scenarios({&scenario, 1});
  store.keep({&run, 1});
}

/// A configuration with values of many options.
inline RunConfig random_config(std::mt19937_64& random) {
  const auto one_of = [&]<class T>(std::initializer_list<T> items) {
    return *(items.begin() + static_cast<std::ptrdiff_t>(random() % items.size()));
  };
  const auto number = [&] { return static_cast<double>(random() % 100000 + 1) * 1e-6; };
  RunConfig config;
  config.scenario = "top";
  const bool adaptive = random() % 3 == 0;
  config.integrator = adaptive ? one_of({"cvode_adams", "cvode_bdf"}) : one_of({"rk4", "heun", "explicit_midpoint"});
  if (adaptive) config.tolerance = number();
  else config.dt = number();
  config.formulation.orientation = one_of({Orientation::quaternion, Orientation::matrix});
  config.formulation.angular_state = one_of({AngularState::velocity_world, AngularState::velocity_body});
  config.formulation.gyroscopic = random() % 2 == 0;
  if (config.formulation.orientation == Orientation::quaternion)
    config.formulation.rotation_from = one_of({RotationFrom::normalized, RotationFrom::stored});
  config.normalize = random() % 2 == 0;
  config.precision = one_of({Precision::single_precision, Precision::double_precision, Precision::extended_precision});
  if (!adaptive && random() % 3 == 0) config.summation = one_of({Summation::plain, Summation::compensated});
  if (adaptive && random() % 2 == 0) config.max_steps = static_cast<std::int64_t>(random() % 1000 + 1);
  config.t_end = 1000 * number();
  if (random() % 2 == 0) config.samples = static_cast<std::int64_t>(random() % 100 + 1);
  config.reference = random() % 4 == 0;
  if (random() % 2 == 0) config.varied.push_back({"body.0.mass", std::to_string(random() % 50 + 2)});
  if (random() % 2 == 0) config.varied.push_back({"body.top.velocity", "[1, 2, 0.5]"});
  return config;
}

}  // namespace polhode::study::query_tests
