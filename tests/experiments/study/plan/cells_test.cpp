// SPDX-License-Identifier: BSD-3-Clause
// The cells of a study: each is made from its number alone, each once, and further points change none.
#include "experiments/study/plan/cells.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "experiments/study/plan/assignments.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::cells_tests::cells_test {
namespace {

/// Cells of a study of built-in scenarios.
Cells cells_of(const StudyAxes& study, bool counted = false) {
  static std::map<std::string, Scenario> scenarios;
  return Cells(dimensions(study, counted), [](const std::string& name) {
    const auto found = scenarios.try_emplace(name, ScenarioSource::open(name).resolve()).first;
    Cells::Start start{{}, &found->second};
    start.config.scenario = name;
    if (!found->second.colliders.empty()) start.config.contact.emplace();
    return start;
  });
}

StudyAxes axes(std::map<std::string, std::string> values) {
  StudyAxes study;
  study.axes = {{"scenario", "peters_hsu"}, {"integrator", "rk4"}, {"dt", "0.01"}};
  for (const auto& [key, text] : values) study.axes[key] = text;
  return study;
}

PointTable table(PointTable::Kind kind, const std::string& text) {
  PointTable made{.kind = kind, .label = "here", .columns = {}};
  for (const auto& [key, values] : assignments(text, "here"))
    made.columns.push_back({axis_key(key, "here"), values, "here " + key});
  return made;
}

std::string words_of(const Cell& cell) {
  std::string text(cell.scenario);
  for (const RunOption& option : run_options()) {
    for (const auto& [given, value] : cell.options) {
      if (given == &option) text += " " + option.name + "=" + text_of(value);
    }
  }
  for (const Override& override : cell.varied) text += " " + override.key + "=" + override.value;
  return text;
}

std::vector<std::string> all_of(const Cells& cells) {
  std::vector<std::string> all;
  for (std::size_t k = 0; k < static_cast<std::size_t>(cells.count()); ++k) all.push_back(words_of(cells.at(k)));
  return all;
}

void expect_each_once(const StudyAxes& study, std::size_t count) {
  const Cells cells = cells_of(study);
  EXPECT_EQ(cells.count(), double(count));
  const auto all = all_of(cells);
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), count);
  EXPECT_GE(cells_of(study, true).count(), double(count)) << "what is refused before it is made";
}

TEST(Cells, AreTheProductOfWhatAffectsARun) {
  expect_each_once(axes({{"dt", "1e-3:1e-1:10:log"}, {"orientation", "quaternion,matrix"}}), 20);
  // dt affects the fixed steps, the tolerance the others; a stored rotation affects quaternions.
  expect_each_once(
      axes({{"integrator", "rk4,lie_euler,cvode_adams"}, {"dt", "0.1,0.2"}, {"tolerance", "1e-4,1e-5,1e-6"}}), 7);
  expect_each_once(axes({{"orientation", "quaternion,matrix"}, {"rotation-from", "normalized,stored"}}), 3);
  // One scenario of two has contact; a compliant response answers no impacts.
  expect_each_once(axes({{"scenario", "peters_hsu,two_cubes"},
                         {"response", "sequential_impulses,compliant"},
                         {"impact-timing", "time_stepping,event_located"}}),
                   4);
}

TEST(Cells, AZipIsOnePointForEachPlace) {
  StudyAxes study = axes({{"integrator", "rk4,cvode_adams"}, {"tolerance", "1e-6"}});
  study.axes.erase("dt");
  study.add_table(table(PointTable::Kind::zip, "dt=0.1,0.2,0.3 t_end=1,2,1"));
  EXPECT_THAT(all_of(cells_of(study)),
              ::testing::UnorderedElementsAre("peters_hsu integrator=rk4 dt=0.1 t-end=1",
                                              "peters_hsu integrator=rk4 dt=0.2 t-end=2",
                                              "peters_hsu integrator=rk4 dt=0.3 t-end=1",
                                              "peters_hsu integrator=cvode_adams tolerance=1e-06 t-end=1",
                                              "peters_hsu integrator=cvode_adams tolerance=1e-06 t-end=2"));
}

TEST(Cells, OptionsThatDecideMayStandInATable) {
  StudyAxes study = axes({{"tolerance", "1e-6,1e-8"}, {"orientation", "quaternion,matrix"}});
  study.axes.erase("integrator");
  study.add_table(table(PointTable::Kind::zip, "integrator=rk4,cvode_adams,rk4 body.0.mass=1,2,1"));
  // Points 0 and 2 are equal: with two orientations, and two tolerances for cvode_adams.
  EXPECT_EQ(cells_of(study).count(), 2 * 2 + 2 * 2);
  const auto all = all_of(cells_of(study));
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), 2U + 4U);
}

TEST(Cells, FurtherPointsAndKeysChangeNone) {
  for (const std::size_t n : {1U, 10U, 100U}) {
    StudyAxes few = axes({}), many = axes({});
    PointTable random = table(PointTable::Kind::random, "body.0.mass=uniform(1,2) t_end=log_uniform(1,10)");
    random.n = n;
    few.add_table(random);
    random.n = 10 * n;
    random.columns.insert(random.columns.begin(), {"body.0.inertia.0", "normal(1,0.1)", "here"});
    many.add_table(random);
    const Cells short_one = cells_of(few), long_one = cells_of(many);
    for (std::size_t k = 0; k < n; ++k) {
      Cell cell = long_one.at(k);
      std::erase_if(cell.varied, [](const Override& override) { return override.key == "body.0.inertia.0"; });
      EXPECT_EQ(words_of(cell), words_of(short_one.at(k)));
    }
  }
}

TEST(Cells, OnlyOptionsThatSayItDecideWhetherOthersApply) {
  // Each other value of an option that does not decide leaves all the others as they apply, from each of many
  // configurations.
  const Scenario contact = ScenarioSource::open("two_cubes").resolve();
  for (const char* method : {"rk4", "cvode_adams", "arkode_erk"}) {
    for (const char* orientation : {"quaternion", "matrix"}) {
      for (const char* response : {"sequential_impulses", "compliant"}) {
        RunConfig config;
        config.contact.emplace();
        const auto set = [&](const char* name, const char* value) { run_option(name).set(config, std::string(value)); };
        set("integrator", method);
        set("orientation", orientation);
        set("response", response);
        const auto applied = [](const RunConfig& c, const RunOption& without) {
          std::set<std::string> names;
          for (const RunOption& option : run_options()) {
            if (&option != &without && option.applies_to(c)) names.insert(option.name);
          }
          return names;
        };
        for (const RunOption& option : run_options()) {
          if (option.decides || option.role == RunOption::Role::scenario || !option.applies_to(config)) continue;
          std::vector<OptionValue> values;
          if (option.kind == RunOption::Kind::whole) values = {std::int64_t{3}};
          else if (option.kind == RunOption::Kind::number) values = {0.5};
          else if (option.kind == RunOption::Kind::flag) values = {std::int64_t{1}};
          else
            for (const std::string& name : option.known()) values.emplace_back(name);
          for (const OptionValue& value : values) {
            RunConfig other = config;
            option.set(other, value);
            EXPECT_EQ(applied(other, option), applied(config, option)) << option.name << " " << text_of(value);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace polhode::study::cells_tests::cells_test
