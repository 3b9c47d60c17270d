// SPDX-License-Identifier: BSD-3-Clause
// Study files: they say the same as the command line, several studies are one list of runs, and errors name their
// place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/portable_random.hpp"
#include "experiments/study/plan/dimension.hpp"
#include "experiments/study/plan/plan.hpp"
#include "experiments/study/plan/where.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/input_error.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::study_file_tests::study_file_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const Experiment tops = {
    .name = "tops",
    .question = "Do file and command line say the same?",
    .defaults = {{"scenario", "peters_hsu"}, {"integrator", "rk4"}, {"dt", "0.1"}, {"tolerance", "1e-6"}}};

class StudyFiles : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
    return (folder_.path() / name).string();
  }
  static Plan planned(std::vector<std::string> words) {
    words.insert(words.begin(), "tops");
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    return make_plan(tops, parse_options(tops, int(argv.size()), argv.data()).options);
  }
  Plan of_file(const std::string& text) const { return planned({"--study", file("study.toml", text)}); }
  static std::set<std::string> ids(const Plan& plan) {
    std::set<std::string> all;
    for (const PlannedRun& run : plan.runs()) all.insert(run.id);
    return all;
  }
  static std::string error_of(const std::vector<std::string>& words) {
    try {
      planned(words);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  /// The error of a study file, without its folder: "study.toml:1:6: …".
  std::string error_in(const std::string& text) const {
    std::string error = error_of({"--study", file("study.toml", text)});
    const std::string folder = folder_.path().string() + "/";
    for (auto at = error.find(folder); at != std::string::npos; at = error.find(folder)) error.erase(at, folder.size());
    return error;
  }

  TemporaryFolder folder_;
};

TEST_F(StudyFiles, WhatIsSaidTwiceIsRefused) {
  EXPECT_EQ(error_of({"--dt", "1", "--dt", "2"}), "--dt: it is given more than once; give it once");
  EXPECT_EQ(error_of({"--random", "n=3 dt=uniform(1,2) n=4"}), "--random n: it stands twice; leave one out");
  EXPECT_EQ(error_of({"--random", "seed=3 n=3 seed=3 dt=uniform(1,2)"}),
            "--random seed: it stands twice; leave one out");
}

TEST_F(StudyFiles, AreNamedWithoutAColonOrWithAStudy) {
  const std::string path = file("study.toml", "[study.first]\ndt = 1\n[study.second]\ndt = 2\n");
  EXPECT_EQ(planned({"--study", path}).size(), 2U);
  EXPECT_EQ(planned({"--study", path + ":second"}).size(), 1U);
  EXPECT_THAT(error_of({"--study", path + ":"}), HasSubstr("no name stands after the colon"));
}

// A glance reads 10 000 scenarios, and a tenth of them where each has a hundred bodies.
TEST_F(StudyFiles, AGlanceReadsFewerScenariosOfManyBodies) {
  const auto rows = [](const char* scenario) {
    const std::vector<const char*> argv = {"tops",
                                           "--scenario",
                                           scenario,
                                           "--integrator",
                                           "semi_implicit_euler",
                                           "--dt",
                                           "0.01",
                                           "--random",
                                           "n=1000000 seed=7 body.0.mass=uniform(1,3)"};
    const auto plan = glance_at_plan(tops, parse_options(tops, int(argv.size()), argv.data()).options);
    EXPECT_TRUE(plan) << scenario;
    if (!plan) return std::size_t{0};
    EXPECT_NEAR(plan->runs_of_a_row * double(plan->size()), 1e6, 1) << scenario << ": the rows stand for all cells";
    return plan->size();
  };
  const std::size_t of_one = rows("peters_hsu"), of_hundred = rows("pile_100");
  EXPECT_EQ(of_one, 10'000u);
  EXPECT_GT(of_hundred, 350u);
  EXPECT_LT(of_hundred, 450u);
}

// The configuration of a run is made with its scenario where a varied key changes the default of an option.
TEST_F(StudyFiles, ConfigurationsAreThoseOfTheRuns) {
  const auto expect_those_of_the_runs = [](const Plan& plan, std::size_t with_own_presets) {
    std::size_t own = 0;
    LastOptions last;
    Variants variants;
    for (std::size_t i = 0; i < plan.size(); ++i) {
      own += plan.rows[i].own_presets;
      const PlannedRun run = plan.run(i);
      for (const RunConfig& config : {run.config, plan.config(i), plan.config(i, &last), plan.run(i, &variants).config})
        EXPECT_EQ(run_number(config, run.scenario->canonical()), plan.rows[i].id) << i;
    }
    EXPECT_EQ(own, with_own_presets);
  };
  expect_those_of_the_runs(planned({"--vary", "body.0.mass=1,2,3"}), 0);
  expect_those_of_the_runs(planned({"--scenario", "peters_hsu,dzhanibekov", "--integrator", "rk4,cvode_adams", "--dt",
                                    "0.1,0.2", "--tolerance", "1e-6,1e-7", "--vary", "body.0.mass=1,2"}),
                           0);
  expect_those_of_the_runs(planned({"--vary", "t_end=10,3", "--vary", "body.0.mass=1,2"}), 2);
  expect_those_of_the_runs(planned({"--vary", "t_end=10,3", "--t-end", "1"}), 1);
  // A sphere and a half space meet by the separating axes, a cylinder by GJK only.
  expect_those_of_the_runs(planned({"--scenario", "bouncing_ball", "--vary",
                                    "body.ball.shape={kind=\"sphere\",radius=0.1};{kind=\"cylinder\",radius=0.1,"
                                    "length=0.2};{kind=\"sphere\",radius=0.2}"}),
                           1);
}

TEST_F(StudyFiles, SayTheSameAsTheCommandLine) {
  const std::string cells = file("cells.csv", "dt,body.0.mass\n0.1,2\n0.2,\n0.25,3\n");
  const Plan from_file = of_file(R"toml(
cells = "cells.csv"
integrator = ["rk4", "cvode_adams"]
where = "body.0.mass < 2.9 or t_end > 1"
[grid]
orientation = ["quaternion", "matrix"]
body.0.velocity.0 = 0
[[zip]]
t_end = [1, 2]
normalize = ["never", "step"]
[random]
n = 3
seed = 5
body.0.angular_velocity = { distribution = "sphere", radius = 2 }
tolerance = "log_uniform(1e-9, 1e-6)"
)toml");
  const Plan from_line = planned(
      {"--integrator", "rk4,cvode_adams", "--where", "body.0.mass < 2.9 or t_end > 1", "--grid",
       "orientation=quaternion,matrix", "--vary", "body.0.velocity.0=0", "--zip", "t-end=1,2 normalize=never,step",
       "--random", "n=3 seed=5 body.0.angular_velocity=sphere(2) tolerance=log_uniform(1e-9,1e-6)", "--cells", cells});
  EXPECT_EQ(ids(from_file), ids(from_line));
  EXPECT_EQ(from_file.size(), 48U);
  EXPECT_EQ(from_file.identity, from_line.identity);
}

TEST_F(StudyFiles, ATableMultipliesWithTheGrid) {
  const Plan plan = planned({"--integrator", "rk4,lie_euler", "--zip", "dt=0.1,0.2 t-end=1,2"});
  std::multiset<std::string> found;
  for (const PlannedRun& run : plan.runs())
    found.insert(run.config.integrator + " " + std::to_string(*run.config.dt).substr(0, 3) + " " +
                 std::to_string(run.config.t_end).substr(0, 1));
  EXPECT_THAT(found, ::testing::ElementsAre("lie_euler 0.1 1", "lie_euler 0.2 2", "rk4 0.1 1", "rk4 0.2 2"));
}

TEST_F(StudyFiles, HoldSeveralStudiesWithSharedDefaults) {
  const std::string path = file("two.toml", R"(
[defaults]
integrator = ["rk4", "lie_euler"]
t_end = 1
[study.wide]
dt = [0.1, 0.2]
[study.long]
t_end = [1, 5]
dt = 0.2
)");
  const Plan both = planned({"--study", path}), wide = planned({"--study", path + ":wide"}),
             later = planned({"--study", path + ":long"});
  EXPECT_EQ(wide.size(), 4U);
  EXPECT_EQ(later.size(), 4U);
  EXPECT_EQ(both.size(), 6U) << "two runs are in both studies, and carried out once";
  std::set<std::string> joined = ids(wide);
  joined.merge(ids(later));
  EXPECT_EQ(ids(both), joined);
  ASSERT_EQ(both.studies.size(), 2U);
  EXPECT_EQ(both.studies[0].name, "wide") << "in the order of the file";
  EXPECT_EQ(ids(planned({"--study", path, "--t-end", "1", "--dt", "0.2"})).size(), 2U) << "the command line wins";
  EXPECT_THAT(error_of({"--study", path + ":lang"}), HasSubstr("it has no study lang; did you mean 'long'?"));
}

TEST_F(StudyFiles, ANearerValueReplacesOneKeyOfATable) {
  const std::string path = file("study.toml", "[zip]\ndt = [0.1, 0.2]\nt_end = [1, 2]\n");
  EXPECT_EQ(planned({"--study", path}).size(), 2U);
  EXPECT_EQ(ids(planned({"--study", path, "--t-end", "3"})), ids(planned({"--dt", "0.1,0.2", "--t-end", "3"})));
}

TEST_F(StudyFiles, WhereLeavesOutCells) {
  const Plan plan = planned({"--dt", "0.1,0.2,0.5", "--vary", "body.box.inertia.1=0.7,0.8", "--integrator",
                             "rk4,cvode_adams", "--where", "not (dt > 0.25 * body.0.inertia.1)"});
  EXPECT_EQ(plan.studies[0].cells, 8U);
  EXPECT_EQ(plan.studies[0].left_out, 3U);
  for (const PlannedRun& run : plan.runs()) {
    EXPECT_LE(run.config.dt.value_or(0), 0.25 * std::stod(run.config.varied[0].value));
  }
  // Cells that could not be made are left out before they are.
  EXPECT_THAT(error_of({"--vary", "body.0.inertia.1=0.7,9"}), HasSubstr("triangle"));
  EXPECT_EQ(planned({"--vary", "body.0.inertia.1=0.7,9", "--where", "body.0.inertia.1 < 1"}).size(), 1U);
  // Keys that the study does not vary are as in the scenario, and t_end may be a key of it.
  EXPECT_EQ(planned({"--where", "t_end == 10 and body.0.inertia.1 > 0 and integrator == 'rk4'"}).size(), 1U);
  EXPECT_EQ(planned({"--vary", "t_end=1,2,3", "--where", "t_end < 2.5"}).size(), 2U);
  EXPECT_EQ(planned({"--vary", "body.0.velocity=[0,0,1];[1,0,0]", "--where", "body.0.velocity.2 == 1"}).size(), 1U);
  EXPECT_EQ(planned({"--where", "dt < 1", "--where", "dt > 0.01"}).size(), 1U);
  EXPECT_THAT(error_of({"--where", "dt < 0"}), StartsWith("--where: it leaves out all 1 cell"));
}

TEST_F(StudyFiles, ConditionsSeeWhatTheRunsHave) {
  const std::string cells =
      file("cells.csv", "dt,body.0.mass,orientation\n0.1,2,matrix\n0.2,,quaternion\n0.25,3,matrix\n,0.5,quaternion\n");
  std::vector<std::string> words = {
      "--grid",
      "dt=0.1",
      "--random",
      "n=200 seed=5 body.0.angular_velocity=sphere(3) integrator=choice(rk4,cvode_adams) "
      "tolerance=log_uniform(1e-9,1e-6) body.0.velocity=choice([0,0,1],[1,0,0]) samples=integer(1,9)",
      "--zip",
      "t_end=1,2 normalize=never,step"};
  const Plan all = planned(words);
  words.insert(words.end(),
               {"--where",
                "body.0.angular_velocity.2 > 0 and body.0.velocity.0 == 0 and samples >= 4 and (integrator "
                "== 'rk4' or tolerance < 1e-7) and (t_end == 1 or normalize != 'step') and body.0.mass > 0"});
  const Plan some = planned(words);
  std::set<std::string> expected;
  for (const PlannedRun& run : all.runs()) {
    std::map<std::string, std::string> varied;
    for (const Override& o : run.config.varied) varied[o.key] = o.value;
    const std::string& turn = varied.at("body.0.angular_velocity");
    const bool up = std::stod(turn.substr(turn.rfind(',') + 1)) > 0,
               still = varied.at("body.0.velocity") == "[0, 0, 1]" || varied.at("body.0.velocity") == "[0,0,1]";
    const bool method = run.config.integrator == "rk4" || *run.config.tolerance < 1e-7;
    if (up && still && *run.config.samples >= 4 && method && (run.config.t_end == 1 || !run.config.normalize))
      expected.insert(run.id);
  }
  EXPECT_GT(expected.size(), 3U);
  EXPECT_LT(expected.size(), all.size() / 2);
  EXPECT_EQ(ids(some), expected);

  const std::vector<std::string> table = {"--cells", cells};
  const auto runs_where = [&](const std::string& condition) {
    return planned({"--cells", cells, "--where", condition}).size();
  };
  EXPECT_THAT(error_of(table), HasSubstr("rk4 needs it, and a row leaves it empty"));
  EXPECT_EQ(runs_where("given(dt)"), 3U);
  EXPECT_EQ(runs_where("given(dt) and orientation == 'matrix'"), 2U);
  EXPECT_EQ(runs_where("dt < 0.22 and body.0.mass > 2.5"), 1U) << "an empty cell leaves the mass of the scenario";
}

TEST_F(StudyFiles, RandomPointsUseTheSeedOfTheCommandLineUnlessTheyHaveTheirOwn) {
  const std::string path = file("study.toml", "[random]\nn = 3\nt_end = \"uniform(1, 2)\"\n");
  EXPECT_EQ(ids(planned({"--study", path})), ids(planned({"--random", "n=3 seed=1 t_end=uniform(1,2)"})));
  EXPECT_EQ(ids(planned({"--study", path, "--seed", "9"})),
            ids(planned({"--random", "n=3 seed=9 t_end=uniform(1,2)"})));
  EXPECT_NE(ids(planned({"--study", path, "--seed", "9"})), ids(planned({"--study", path})));
}

TEST_F(StudyFiles, CurvesSayTheSameAsOnTheCommandLine) {
  const auto curves = [&](const std::string& text, std::vector<std::string> words = {}) {
    words.insert(words.begin(), {"tops", "--study", file("study.toml", text)});
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    return parse_options(tops, int(argv.size()), argv.data()).options.curves;
  };
  EXPECT_EQ(curves("dt = 0.1\n"), 2000U);
  EXPECT_EQ(curves("curves = \"none\"\n"), 0U);
  EXPECT_EQ(curves("curves = 7\n"), 7U);
  EXPECT_EQ(curves("curves = \"7\"\n"), 7U);
  EXPECT_EQ(curves("curves = \"all\"\n"), std::nullopt);
  EXPECT_EQ(curves("curves = 7\n", {"--curves", "all"}), std::nullopt) << "the command line wins";
  EXPECT_EQ(curves("[defaults]\ncurves = 3\n[study.a]\ndt = 1\n"), 3U);
  EXPECT_THAT(error_in("curves = 2.5\n"), StartsWith("study.toml:1:10: curves 2.5: is no whole number"));
  EXPECT_THAT(error_in("curves = \"some\"\n"), StartsWith("study.toml:1:10: curves some: is no whole number"));
  EXPECT_THAT(error_in("curves = \"\"\n"), StartsWith("study.toml:1:10: curves: is empty"));
  EXPECT_THAT(error_in("curves = true\n"), StartsWith("study.toml:1:10: curves: must be"));
  EXPECT_THAT(error_in("[study.a]\ncurves = 3\n"),
              StartsWith("study.toml:2:10: study.a.curves: it is for all studies of the file"));
}

TEST_F(StudyFiles, ErrorsNameTheirPlace) {
  const auto csv = [&](const std::string& text) {
    file("cells.csv", text);
    return error_in("cells = \"cells.csv\"\n");
  };
  EXPECT_THAT(error_in("[zip]\ndt = [0.1, 0.2]\nt_end = [1, 2, 3]\n"),
              StartsWith("study.toml:3:9: zip.t_end: 3 values of t-end, but 2 of dt; give each key as many"));
  EXPECT_THAT(error_in("[zip]\ndtt = 1\n"), StartsWith("study.toml:2:7: zip.dtt: no such axis; did you mean 'dt'?"));
  EXPECT_THAT(error_in("[grid]\n\"body.0.weight\" = 1\n"),
              AllOf(StartsWith("study.toml:2:19: grid.body.0.weight: "), HasSubstr("weight")));
  EXPECT_THAT(error_in("dt = 0.1\n[zip]\ndt = 0.1\n"),
              AllOf(HasSubstr("study.toml:3:6: zip.dt: dt is given twice"), HasSubstr("study.toml:1:6: dt")));
  EXPECT_THAT(error_in("[random]\nn = 0\ndt = \"uniform(1, 2)\"\n"),
              StartsWith("study.toml:2:5: random.n: 0 points; n must be"));
  EXPECT_THAT(error_in("[random]\nn = 2.5\ndt = \"uniform(1, 2)\"\n"), HasSubstr("2.5 points"));
  EXPECT_THAT(error_in("[random]\nseed = -1\n"), StartsWith("study.toml:2:8: random.seed: -1 is no seed"));
  EXPECT_THAT(error_in("[random]\ndt = \"uniform(1, 2)\"\n"), HasSubstr("the number of points is missing"));
  EXPECT_THAT(error_in("[random]\nn = 3\n"), HasSubstr("no key is drawn"));
  EXPECT_THAT(error_in("[random]\nn = 3\ndt = 5\n"), StartsWith("study.toml:3:6: random.dt: must be a distribution"));
  EXPECT_THAT(error_in("[random]\nn = 3\ndt = { distribution = \"uniform\", from = 1, too = 3 }\n"),
              AllOf(HasSubstr("study.toml:3:"), HasSubstr("too: no such parameter; did you mean 'to'?")));
  EXPECT_THAT(error_in("[random]\nn = 3\ndt = { distribution = \"uniform\", from = 1 }\n"),
              HasSubstr("uniform needs its parameter 'to'"));
  EXPECT_THAT(error_in("\nwhere = \"dtt < 1\"\n"),
              StartsWith("study.toml:2:9: where: dtt: no such axis; did you mean 'dt'?"));
  EXPECT_THAT(
      error_in("where = \"integrator == rk4\"\n"),
      StartsWith("study.toml:1:9: where: rk4 is a value of integrator; put it into quotes, as in integrator =="));
  EXPECT_THAT(error_in("[random]\nn = 3\nsamples = \"uniform(1, 9)\"\n"),
              StartsWith("study.toml:3:11: random.samples: uniform makes numbers that are not whole; take integer("));
  EXPECT_THAT(error_in("where = \"dt <\"\n"), StartsWith("study.toml:1:9: where: character 5: "));
  EXPECT_THAT(error_in("where = \"body.0.inertia < 1\"\n"), HasSubstr("body.0.inertia: it is a list"));
  EXPECT_THAT(error_in("where = \"body.0.weight < 1\"\n"), HasSubstr("weight"));
  EXPECT_THAT(error_in("where = \"dt < 0\"\n"), HasSubstr("it leaves out all"));
  EXPECT_THAT(error_in("dt = 1\n[study.a]\ndt = 2\n"), StartsWith("study.toml:1:6: dt: it stands beside [study.…]"));
  EXPECT_THAT(error_in("[defaults]\ndt = 1\n"), HasSubstr("there are defaults and no study"));
  EXPECT_THAT(error_in("cells = \"none.csv\"\n"), StartsWith("study.toml:1:9: cells: there is no file none.csv"));
  EXPECT_THAT(csv("dt,colour\n0.1,red\n"), StartsWith("cells.csv:1:4: colour: no such axis"));
  EXPECT_THAT(csv("dt,t_end\n0.1\n"), StartsWith("cells.csv:2:1: 1 cells under 2 column names"));
  EXPECT_THAT(csv("dt,t_end\n0.1,1\n0.1,-1\n"), StartsWith("cells.csv:3:5: t-end: -1 is not positive"));
  EXPECT_THAT(csv("dt,t_end,t-end\n0.1,1,1\n"), HasSubstr("cells.csv:1:10: the column t-end stands twice"));
  EXPECT_THAT(csv("dt\n"), HasSubstr("there is no row"));
  EXPECT_THAT(csv("integrator,dt\n,1\n"), StartsWith("cells.csv:2:1: integrator is empty"));
  EXPECT_THAT(csv("body.0.mass\n1\n-2\n"), StartsWith("cells.csv:3: body.0.mass: -2 is not"));
  EXPECT_THAT(csv("dt\n0.1:0.2:3\n"), HasSubstr("several values"));
}

TEST_F(StudyFiles, DamagedFilesAreReadOrRefused) {
  file("cells.csv", "dt,body.0.mass\n0.1,2\n");
  const std::string whole = R"toml(
[defaults]
integrator = ["rk4", "dmv"]
[study.a]
cells = "cells.csv"
where = "dt < 0.1 * body.0.inertia.1 and not (integrator == 'rk4' or t_end > max(1, 10))"
[study.a.zip]
t_end = [1, 2]
body.0.velocity = [[1, 0, 0], [0, 1, 0]]
[study.a.random]
n = 10
seed = 3
body.0.inertia.1 = { distribution = "normal", mean = 1, deviation = 0.1 }
samples = "integer(1, 10)"
)toml";
  constexpr std::string_view bytes = "\n\"'[]{}().,=:;-#ae09 \xff";
  PortableRandom random(1);
  int read = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = whole;
    for (int k = random.below(4); k >= 0; --k) {
      const auto at = std::size_t(random.below(int(text.size()) - 8));
      if (random.chance(0.3)) text.erase(at, std::size_t(random.below(8)));
      else if (random.chance(0.3)) text.insert(at, text.substr(std::size_t(random.below(int(text.size()) - 8)), 8));
      else text[at] = bytes[std::size_t(random.below(int(bytes.size())))];
    }
    try {
      for (const StudyAxes& study : read_study_file(file("damaged.toml", text), 1).studies) {
        dimensions(study, false);
        for (const Condition& condition : study.where) Where(condition.text, condition.label);
      }
      ++read;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(read, 30) << "some damage leaves a study";
  EXPECT_LT(read, 2500);
}

TEST_F(StudyFiles, CountsThatCannotBeMeantAreRefusedBeforeTheyAreMade) {
  EXPECT_THAT(error_of({"--dt", "1e-3:1e-1:1000000", "--t-end", "1:10:1000000"}),
              StartsWith("1000000000000 runs are more than the 10 million"));
  EXPECT_THAT(error_of({"--vary", "body.0.mass=1:2:1000000", "--vary", "body.0.velocity.0=1:2:1000000", "--vary",
                        "body.0.velocity.1=1:2:1000000"}),
              StartsWith("1e+18 runs are more"));
  EXPECT_THAT(error_of({"--random", "n=10000000 dt=uniform(1,2)", "--t-end", "1,2"}), StartsWith("20000000 runs"));
  EXPECT_THAT(error_of({"--random", "n=10000001 dt=uniform(1,2)"}), HasSubstr("10000001 points; n must be"));
}

}  // namespace
}  // namespace polhode::study::study_file_tests::study_file_test
