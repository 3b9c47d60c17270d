// SPDX-License-Identifier: BSD-3-Clause
// The store: every value comes back, a row at a time, by id or all together, with curves or without.
#include "experiments/study/store/store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/experiments/study/store/loaded.hpp"
#include "tests/experiments/study/store/stored_runs.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::store_tests::store_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

void change(const std::filesystem::path& folder, const std::string& sql) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open((folder / Store::file_name).c_str(), &db), SQLITE_OK);
  char* why = nullptr;
  EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, &why), SQLITE_OK) << sql << ": " << (why ? why : "");
  sqlite3_free(why);
  sqlite3_close(db);
}

std::string refusal(const std::filesystem::path& folder) {
  try {
    const Store store(folder);
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

TEST(Store, ARowTakesNoValueFromTheRowBefore) {
  const TemporaryFolder folder;
  auto runs = made_up_runs(3);
  runs[1].result = {};
  runs[1].result.status = "failed";
  Store(folder.path()).keep(runs);
  const auto loaded = load(Store(folder.path()));
  for (const RunRecord& run : runs) EXPECT_EQ(text_of_result(loaded.runs.at(run.id)), text_of_result(run.result));
}

TEST(Store, EveryValueComesBackInEveryWayOfReading) {
  const TemporaryFolder folder;
  const auto runs = made_up_runs(20);
  Store(folder.path()).keep(runs);
  const Store store(folder.path());
  const auto loaded = load(store);
  EXPECT_TRUE(loaded.damaged.empty());
  ASSERT_EQ(loaded.runs.size(), runs.size());
  std::vector<std::uint64_t> ids;
  for (const RunRecord& run : runs) {
    EXPECT_EQ(text_of_result(loaded.runs.at(run.id)), text_of_result(run.result));
    const auto found = store.find(run.id, Curves::with);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->damage, "");
    EXPECT_EQ(text_of_result(found->result), text_of_result(run.result));
    RunResult bare = run.result;
    bare.series.clear();
    bare.attitude_errors.clear();
    EXPECT_EQ(text_of_result(store.find(run.id, Curves::without)->result), text_of_result(bare));
    ids.push_back(number_of_id(run.id));
  }
  std::sort(ids.begin(), ids.end());
  EXPECT_EQ(store.ids(), ids);
  EXPECT_FALSE(store.find("0123456789abcdef", Curves::with));
  std::size_t count = 0;
  store.for_each(Curves::without, [&](StoredRun&& run) {
    EXPECT_EQ(run.damage, "");
    EXPECT_TRUE(run.result.series.empty());
    ++count;
  });
  EXPECT_EQ(count, runs.size());
}

TEST(Store, RunsAreReadOneAfterAnotherInAnyOrder) {
  const TemporaryFolder folder;
  const auto runs = made_up_runs(10);
  {
    Store store(folder.path());
    store.keep(runs);
    store.forget({{store.find(runs[6].id, Curves::without)->number}});
  }
  change(folder.path(), "UPDATE runs SET steps = steps + 1 WHERE number = 4");
  const Store store(folder.path());
  for (int time = 0; time < 2; ++time) {
    Store::Reading reading(store);
    for (const std::size_t k :
         {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U, 9U, 8U, 7U, 0U, 1U, 2U, 6U, 3U, 5U, 4U, 5U, 9U, 0U}) {
      RunResult result;
      const auto damage = reading.find(number_of_id(runs[k].id), result);
      ASSERT_EQ(damage.has_value(), k != 6) << k;
      if (!damage) continue;
      EXPECT_EQ(*damage, k == 3 ? "runs.checksum" : "");
      RunResult bare = runs[k].result;
      drop_curves(bare);
      if (k == 3) continue;
      EXPECT_EQ(text_of_result(result), text_of_result(bare)) << k;
    }
  }
}

TEST(Store, RunsThatAreNotCommittedAreGone) {
  const TemporaryFolder folder;
  const auto runs = made_up_runs(4);
  Store store(folder.path());
  {
    Store::Keeping keeping(store);
    keeping.add(runs);
  }
  EXPECT_TRUE(store.ids().empty());
  {
    Store::Keeping keeping(store);
    keeping.add(std::span(runs).first(1));
    keeping.add(std::span(runs).subspan(1));
    EXPECT_TRUE(Store::ids_in(folder.path()).empty()) << "before the commit";
    keeping.commit();
  }
  const auto loaded = load(Store(folder.path()));
  ASSERT_EQ(loaded.runs.size(), runs.size());
  for (const RunRecord& run : runs) EXPECT_EQ(text_of_result(loaded.runs.at(run.id)), text_of_result(run.result));
  const auto configurations = store.configurations();
  store.for_each(Curves::without, [&](StoredRun&& run) { EXPECT_TRUE(configurations.contains(run.configuration)); });
}

TEST(Store, ARowWithoutAnIdIsOneDamagedRun) {
  const TemporaryFolder folder;
  const auto runs = made_up_runs(4);
  Store(folder.path()).keep(runs);
  change(folder.path(), "UPDATE runs SET id = 'abc' WHERE number = 2; UPDATE runs SET id = 0.5 WHERE number = 3");
  EXPECT_EQ(Store::ids_in(folder.path()).size(), 2u);
  Store store(folder.path());
  EXPECT_EQ(store.ids().size(), 2u);
  EXPECT_EQ(store.rows_without_id(), (std::vector<std::int64_t>{2, 3}));
  EXPECT_TRUE(store.ids_with("0").empty()) << "0.5 is no id";
  std::vector<std::string> said;
  store.for_each(Curves::with, [&](StoredRun&& run) { said.push_back(run.name() + " " + run.damage); });
  EXPECT_EQ(said, (std::vector<std::string>{"run " + runs[0].id + " ", "row 2 runs.id", "row 3 runs.id",
                                            "run " + runs[3].id + " "}));
  {
    Store::Reading reading(store);
    for (const std::size_t k : {0U, 1U, 2U, 3U}) {
      RunResult result;
      const auto damage = reading.find(number_of_id(runs[k].id), result);
      EXPECT_EQ(damage.has_value(), k == 0 || k == 3) << k;
    }
  }
  store.forget(store.rows_without_id());
  store.keep(runs);
  const auto loaded = load(store);
  EXPECT_TRUE(loaded.damaged.empty());
  EXPECT_EQ(loaded.runs.size(), runs.size());
}

TEST(Store, ARunKeptAgainIsReplacedAndARunForgottenIsGone) {
  const TemporaryFolder folder;
  auto runs = made_up_runs(3);
  Store store(folder.path());
  store.keep(runs);
  runs[0].result.steps = 5;
  runs[0].result.series.clear();  // without curves from now on
  runs[0].result.attitude_errors.clear();
  store.keep({&runs[0], 1});
  EXPECT_EQ(text_of_result(store.find(runs[0].id, Curves::with)->result), text_of_result(runs[0].result));
  store.forget({{store.find(runs[1].id, Curves::without)->number}});
  EXPECT_FALSE(store.find(runs[1].id, Curves::with));
  EXPECT_EQ(store.ids().size(), 2u);
  for (const char* table : {"runs", "timings"})
    EXPECT_EQ(store.database().number(std::string("SELECT count(*) FROM ") + table), 2) << table;
}

TEST(Store, AValueThatCouldNotBeReadBackIsNotKept) {
  const TemporaryFolder folder;
  Store store(folder.path());
  for (const auto spoil :
       {+[](RunRecord& r) { r.result.status = "perhaps"; }, +[](RunRecord& r) { r.result.drift_class = "steep"; },
        +[](RunRecord& r) { r.result.energy_initial = std::numeric_limits<double>::infinity(); },
        +[](RunRecord& r) { r.result.steps = -1; },
        +[](RunRecord& r) { r.result.t_reached = std::numeric_limits<double>::infinity(); },
        +[](RunRecord& r) { r.result.seconds = std::numeric_limits<double>::quiet_NaN(); },
        +[](RunRecord& r) {
          r.result.invariant_drift_max_rel = {{"p_psi", std::numeric_limits<double>::infinity()}};
        },
        +[](RunRecord& r) {
          r.result.invariant_drift_max_rel = {{"p=psi", 1}};
        },
        +[](RunRecord& r) {
          r.result.invariant_drift_max_rel = {{"p psi", 1}};
        },
        +[](RunRecord& r) {
          r.result.invariant_drift_max_rel = {{"", 1}};
        },
        +[](RunRecord& r) {
          r.result.attitude_errors = {{0, std::numeric_limits<double>::quiet_NaN()}};
        },
        +[](RunRecord& r) {
          r.result.series = {{1, 0, 0, 0, 0}, {0, 0, 0, 0, 0}};
        },
        +[](RunRecord& r) { r.id = "7"; }}) {
    RunRecord run = made_up_run(0);
    spoil(run);
    EXPECT_THROW(store.keep({&run, 1}), std::logic_error);
  }
  EXPECT_TRUE(store.ids().empty());
}

TEST(Store, ColumnsAreFoundByName) {
  const TemporaryFolder folder;
  const auto runs = made_up_runs(3);
  Store(folder.path()).keep(runs);
  change(folder.path(),
         "ALTER TABLE runs RENAME COLUMN status TO old; ALTER TABLE runs ADD COLUMN status TEXT;"
         "UPDATE runs SET status = old; ALTER TABLE runs DROP COLUMN old");
  const auto loaded = load(Store(folder.path()));
  EXPECT_TRUE(loaded.damaged.empty());
  for (const RunRecord& run : runs) EXPECT_EQ(text_of_result(loaded.runs.at(run.id)), text_of_result(run.result));
}

TEST(Store, AStoreOfAnotherVersionIsRefusedInOneLine) {
  const TemporaryFolder folder;
  const auto fresh = [&] {
    std::filesystem::remove(folder.path() / Store::file_name);
    Store(folder.path()).keep(made_up_runs(2));
  };
  const std::string file = (folder.path() / Store::file_name).string();
  for (const auto& [sql, said] : std::vector<std::pair<std::string, std::string>>{
           {"PRAGMA user_version=77", "schema version 77, and this program reads version 2"},
           {"PRAGMA user_version=0; PRAGMA application_id=0", "schema version 0, and this program reads version 2"},
           {"PRAGMA application_id=5", "no store of polhode"},
           {"ALTER TABLE runs ADD COLUMN colour TEXT", "has the further column colour"},
           {"ALTER TABLE runs DROP COLUMN drift_exponent", "lacks the column drift_exponent"},
           {"ALTER TABLE runs RENAME COLUMN steps TO strides", "strides"},
           {"ALTER TABLE timings DROP COLUMN wall_s; ALTER TABLE timings ADD COLUMN wall_s TEXT", "has wall_s as TEXT"},
           {"DROP TABLE curves", "curves is missing"},
           {"DROP TABLE scenarios", "scenarios is missing"},
           {"DROP TABLE studies", "studies is missing"},
           {"DROP TABLE configurations", "configurations is missing"},
           {"ALTER TABLE scenarios RENAME COLUMN source TO src", "scenarios has the further column src"},
           {"ALTER TABLE scenarios DROP COLUMN source", "scenarios lacks the column source"},
           {"ALTER TABLE studies DROP COLUMN manifest", "studies lacks the column manifest"},
           {"ALTER TABLE configurations RENAME COLUMN key TO number",
            "configurations has another primary key than key"},
           {"ALTER TABLE configurations ADD COLUMN colour TEXT DEFAULT 'red'",
            "configurations has a default for colour"},
           {"DROP TABLE runs; CREATE TABLE runs (id TEXT)", "has id as TEXT"}}) {
    fresh();
    change(folder.path(), sql);
    const std::string why = refusal(folder.path());
    EXPECT_THAT(why, AllOf(HasSubstr(file), HasSubstr(said))) << sql;
    EXPECT_EQ(why.find('\n'), std::string::npos);
    EXPECT_THROW(Store::ids_in(folder.path()), std::runtime_error) << sql;
  }
}

TEST(Store, ARunOfASummaryTakesLessThan1200BytesWithoutCurves) {
  const TemporaryFolder folder;
  std::vector<RunRecord> runs = made_up_runs(5000);
  for (RunRecord& run : runs) {
    run.result.series.clear();
    run.result.attitude_errors.clear();
  }
  Store(folder.path()).keep(runs);
  EXPECT_LT(std::filesystem::file_size(folder.path() / Store::file_name), 1200 * runs.size());
}

TEST(Store, ConfigurationsStandOnceAndRunsReferToThem) {
  const TemporaryFolder folder;
  std::vector<RunRecord> runs = made_up_runs(6);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    RunConfig& config = runs[k].config;
    config.scenario = "lagrange_top";
    config.integrator = "rk4";
    config.dt = k < 3 ? 0.25 : 0.5;
    if (k == 5) config.max_steps = 7;
    config.varied = {{.key = "body.0.mass", .value = std::to_string(k)}, {.key = "gravity", .value = ""}};
  }
  {
    Store store(folder.path());
    store.keep({runs.data(), 2});
    store.keep(runs);
  }
  const Store store(folder.path(), metric_table(), Access::read);
  const auto configurations = store.configurations();
  ASSERT_EQ(configurations.size(), 3u);
  for (const RunRecord& run : runs) {
    const Configuration& found = configurations.at(key_of(configuration_of(run.config)));
    EXPECT_EQ(found, configuration_of(run.config));
    EXPECT_EQ(found.at("dt_s"), OptionValue(*run.config.dt));
    EXPECT_EQ(found.at("integrator"), OptionValue(std::string("rk4")));
    EXPECT_EQ(found.contains("max_steps"), run.config.max_steps.has_value());
    EXPECT_FALSE(found.contains("tolerance"));
  }
  EXPECT_EQ(varied_text(runs[4].config), "body.0.mass=4");
  EXPECT_EQ(load(store).runs.size(), runs.size());
  EXPECT_EQ(store.configuration_keys().size(), 3u);
  change(folder.path(), "UPDATE configurations SET dt_s = 0.125 WHERE dt_s = 0.25");
  EXPECT_EQ(Store(folder.path()).configurations().size(), 2u) << "a damaged one is left out";
  const auto keys = Store(folder.path()).configuration_keys();
  EXPECT_EQ(keys.size(), 2u);
  EXPECT_FALSE(keys.contains(key_of(configuration_of(runs[0].config))));
  EXPECT_TRUE(keys.contains(key_of(configuration_of(runs[5].config))));
}

TEST(Store, AnIdIsANumberOf16HexadecimalDigits) {
  for (const char* id : {"0000000000000000", "0123456789abcdef", "ffffffffffffffff", "8000000000000000"})
    EXPECT_EQ(id_of_number(number_of_id(id)), id);
  for (const char* id : {"", "1", "0123456789abcdeg", "0123456789abcdef0", "-123456789abcdef"})
    EXPECT_THROW(number_of_id(id), std::logic_error) << id;
}

}  // namespace
}  // namespace polhode::study::store_tests::store_test
