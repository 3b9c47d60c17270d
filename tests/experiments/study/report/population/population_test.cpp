// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/population/population.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "experiments/study/record/run_options.hpp"

namespace polhode::study::population_test {
namespace {

/// Runs of a square of values of two keys, 101 … 100 + side. The energy drift is the product of what is above 100.
StudyView square(std::size_t side, const std::vector<std::string>& methods) {
  StudyView study;
  study.varied_keys = {"body.0.mass", "gravity.2"};
  for (const std::string& method : methods) {
    for (std::size_t a = 1; a <= side; ++a) {
      for (std::size_t b = 1; b <= side; ++b) {
        RunRecord run;
        run.id = fmt::format("{:08x}{:08x}", a, b);
        run.config.scenario = "top";
        run.config.integrator = method;
        run.config.dt = 0.01;
        run.config.varied = {{"body.0.mass", std::to_string(100 + a)}, {"gravity.2", std::to_string(100 + b)}};
        run.result.status = "ok";
        run.result.energy_drift_max_rel = double(a) * double(b);
        study.runs.push_back(run);
      }
    }
  }
  return study;
}

Population counted(const StudyView& study) {
  Population population(study);
  for (const RunRecord& run : study.runs) population.add(run, config_cells(run.config, study.named));
  return population;
}

const Figure* figure(const Analysis& analysis, const std::string& name) {
  for (const Figure& f : analysis.figures) {
    if (f.name == name) return &f;
  }
  return nullptr;
}

TEST(Population, HasTheDistributionOfEachMethod) {
  StudyView study = square(40, {"rk4", "heun"});
  study.runs[3].result.energy_drift_max_rel.reset();
  study.runs[3].result.status = "failed";
  study.runs[3].result.message = "it broke";
  const Population population = counted(study);
  EXPECT_EQ(population.runs(), 3200u);
  EXPECT_EQ(population.outcomes().at("ok").runs, 3199u);
  EXPECT_EQ(population.outcomes().at("failed").runs, 1u);
  EXPECT_EQ(population.outcomes().at("failed").message, "it broke");
  const Analysis analysis = population.analysis();
  const Table& table = analysis.tables.at(0).table;
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_THAT(table.rows[0], testing::ElementsAre("largest energy drift (relative)", "rk4", "1599", "1", testing::_,
                                                  testing::_, testing::_, "1600", "0000002800000028"));
  EXPECT_EQ(table.rows[1][2], "1600");
  EXPECT_NEAR(std::stod(table.rows[1][5]), 320, 3.3) << "the median of products";
}

TEST(Population, DrawsDistributionsEnvelopesAndAMap) {
  const Analysis analysis = counted(square(64, {"rk4"})).analysis();
  ASSERT_TRUE(figure(analysis, "distributions") && figure(analysis, "envelopes") && figure(analysis, "maps"));
  const Figure& envelopes = *figure(analysis, "envelopes");
  ASSERT_EQ(envelopes.panels.size(), 2u);
  const PlottedCurve& median = envelopes.panels[0].curves.at(0);
  ASSERT_EQ(median.points.size(), 32u);
  for (const Point& p : median.points) EXPECT_NEAR(p.value / (32.5 * (p.x - 100)), 1, 0.6) << p.x;
  EXPECT_LT(median.points.front().value, median.points.back().value / 10);
  const Figure& map = *figure(analysis, "maps");
  ASSERT_EQ(map.panels.size(), 1u);
  EXPECT_EQ(map.panels[0].cells.size(), 32u * 32u);
  EXPECT_EQ(map.shades.size(), 4u) << "1 to 4096 are four decades";
  for (const MapCell& cell : map.panels[0].cells) {
    const double product = (cell.x_low - 100) * (cell.y_low - 100);
    if (product > 1000 && cell.shade < 3) ADD_FAILURE() << "the shade of " << product << " is " << cell.shade;
  }
}

TEST(Population, OfOneAxisHasNoMap) {
  StudyView study = square(40, {"rk4"});
  std::erase_if(study.runs, [](const RunRecord& run) { return run.config.varied[1].value != "103"; });
  const Analysis analysis = counted(study).analysis();
  EXPECT_FALSE(figure(analysis, "maps"));
  EXPECT_EQ(figure(analysis, "envelopes")->panels.size(), 1u);
}

}  // namespace
}  // namespace polhode::study::population_test
