// SPDX-License-Identifier: BSD-3-Clause
// Makes a store of many runs, made up, for results.sh: million_runs FOLDER [RUNS].
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/store/store.hpp"
#include "tests/experiments/study/store/stored_runs.hpp"

int main(int argc, char** argv) {
  using namespace polhode::study;
  if (argc < 2) {
    std::fputs("usage: million_runs FOLDER [RUNS]\n", stderr);
    return 2;
  }
  try {
    const std::uint64_t runs = argc > 2 ? std::stoull(argv[2]) : 1'000'000;
    const char* const methods[] = {"rk4", "heun", "explicit_midpoint", "dmv", "lie_midpoint"};
    std::filesystem::create_directories(argv[1]);
    Store store(argv[1]);
    const Scenario scenario = ScenarioSource::open("lagrange_top").resolve();
    store.keep_scenarios({&scenario, 1});
    std::vector<RunRecord> records;
    for (std::uint64_t k = 0; k < runs; ++k) {
      RunRecord& record = records.emplace_back(store_tests::made_up_run(k));
      record.result.series.clear();
      record.result.attitude_errors.clear();
      RunConfig& config = record.config;
      config.scenario = "lagrange_top";
      config.integrator = methods[k % 5];
      config.dt = 0.0001 * static_cast<double>(1 + k / 5 % 200);
      config.varied = {{"body.0.mass", std::to_string(1 + k / 1000)}};
      if (records.size() < 10'000 && k + 1 < runs) continue;
      store.keep(records);
      records.clear();
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "million_runs: %s\n", error.what());
    return 3;
  }
  return 0;
}
