// SPDX-License-Identifier: BSD-3-Clause
// The rest of a trajectory: cut, damaged and incomplete files, and that the bytes do not depend on when blocks end.
#include "experiments/study/trajectory/kept_trajectory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "experiments/study/run/run.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/trajectory/quick_look.hpp"
#include "experiments/study/trajectory/trajectory.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::kept_trajectory_test {
namespace {

namespace fs = std::filesystem;
using Condition = KeptTrajectory::Condition;
using testing::HasSubstr;

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

/// Two cubes that collide, in steps of `dt` (s) until `t_end` (s).
void write_cubes(TrajectoryFormat format, const fs::path& folder, double dt, double t_end = 1, BlockEnd block = {}) {
  const Scenario scenario = ScenarioSource::open("two_cubes").resolve();
  RunConfig config;
  config.scenario = scenario.name;
  config.integrator = "rk4";
  config.dt = dt;
  config.t_end = t_end;
  config.contact = ContactConfig{"sweep_and_prune", "sat", "sequential_impulses", "time_stepping"};
  TrajectoryRequest request{format, folder};
  request.open = [&](const System<double>& system) { return open_trajectory(format, folder, system, block); };
  const RunResult result = carry_out(config, scenario, request, nullptr);
  ASSERT_EQ(result.status, "ok") << result.message;
  EXPECT_FALSE(has_trajectory(format, folder)) << "before it is on the disk";
  finish_trajectories(format, {folder});
}

constexpr std::size_t every = 1, never = std::size_t(-1);
constexpr BlockEnd at_each_instant{every, std::chrono::milliseconds(0)}, at_the_end{never, std::chrono::hours(1)};

class KeptTrajectories : public testing::Test {
 protected:
  KeptTrajectory kept(TrajectoryFormat format) const {
    const auto found = kept_trajectory(folder_, format);
    EXPECT_TRUE(found.has_value());
    return found.value_or(KeptTrajectory{});
  }

  TemporaryFolder holder_;
  fs::path folder_ = holder_.path() / "run";
};

TEST_F(KeptTrajectories, TheBytesDoNotDependOnWhenBlocksEnd) {
  for (const auto format : {TrajectoryFormat::csv, TrajectoryFormat::hdf5}) {
    write_cubes(format, folder_ / "often", 1e-3, 10, at_each_instant);
    write_cubes(format, folder_ / "never", 1e-3, 10, at_the_end);
    write_cubes(format, folder_ / "usual", 1e-3, 10);
    for (const std::string& name : trajectory_files(format)) {
      const std::string bytes = bytes_of(folder_ / "often" / name);
      EXPECT_GT(bytes.size(), 100u) << name;
      EXPECT_TRUE(bytes == bytes_of(folder_ / "never" / name)) << name;
      EXPECT_TRUE(bytes == bytes_of(folder_ / "usual" / name)) << name;
    }
  }
}

TEST_F(KeptTrajectories, OfARunUnderWayHoldEachBlockThatEnded) {
  const Scenario scenario = ScenarioSource::open("two_cubes").resolve();
  const auto system = make_system<double>(scenario.problem, {});
  const BlockEnd blocks[] = {{every, std::chrono::hours(1)}, {never, std::chrono::milliseconds(0)}, at_the_end};
  for (const auto format : {TrajectoryFormat::csv, TrajectoryFormat::hdf5}) {
    for (const BlockEnd& block : blocks) {
      const auto writer = open_trajectory(format, folder_, *system, block);
      State<double> state = system->start();
      for (std::uint64_t k = 0; k < 5; ++k) {
        state.t = 0.1 * double(k);
        const Sample sample{state.t, system->measure(state.y), 0, 0};
        k == 0 ? writer->on_start(state, sample) : writer->on_state(state, sample);
        const fs::path other = holder_.path() / "copy";  // HDF5 does not open a file twice in one process
        fs::remove_all(other);
        fs::copy(folder_, other);
        const KeptTrajectory found = kept_trajectory(other, format).value();
        EXPECT_EQ(found.condition, Condition::unfinished);
        EXPECT_EQ(found.instants, block.rows == never && block.age.count() > 0 ? 0 : k + 1);
        EXPECT_TRUE(found.instants == 0 || found.t_last == state.t);
      }
    }
  }
}

TEST_F(KeptTrajectories, AreWholeWhenTheirRunEnded) {
  for (const auto format : {TrajectoryFormat::csv, TrajectoryFormat::hdf5}) {
    EXPECT_FALSE(kept_trajectory(folder_, format));
    write_cubes(format, folder_, 1e-2);
    EXPECT_TRUE(has_trajectory(format, folder_));
    EXPECT_EQ(in_words(kept(format)), "whole, 101 instants until t = 1 s");
    const fs::path last = folder_ / trajectory_files(format).back();
    put(unfinished(last), "");
    EXPECT_FALSE(has_trajectory(format, folder_)) << "it is being made again";
  }
}

TEST_F(KeptTrajectories, AreWholeWhereTheLastEventComesARoundingAfterTheEnd) {
  write_cubes(TrajectoryFormat::csv, folder_, 1e-2);
  const fs::path events = folder_ / "events.csv";
  const std::string before = bytes_of(events);
  const auto with_event_at = [&](const std::string& t) {
    put(events, before + t + ",impact,0,1,0,0,0,0,0,1,1,0\n");
    return in_words(kept(TrajectoryFormat::csv));
  };
  EXPECT_EQ(with_event_at("1.0000000000000004"), "whole, 101 instants until t = 1 s");
  EXPECT_THAT(with_event_at("1.0001"), HasSubstr("same whole instant"));
}

TEST_F(KeptTrajectories, InCsvThatAreCutEndAtAWholeInstant) {
  write_cubes(TrajectoryFormat::csv, folder_, 1e-2);
  const fs::path motion = folder_ / "trajectory.csv", energy = folder_ / "energy.csv";
  const std::string whole = bytes_of(motion), ledger = bytes_of(energy);
  fs::rename(motion, unfinished(motion));
  std::mt19937 random(5);
  for (int trial = 0; trial < 60; ++trial) {
    const std::string part = whole.substr(0, random() % whole.size());
    put(unfinished(motion), part);
    const auto lines = std::count(part.begin(), part.end(), '\n');
    const KeptTrajectory found = kept(TrajectoryFormat::csv);
    ASSERT_EQ(found.condition, Condition::unfinished) << in_words(found);
    ASSERT_EQ(std::int64_t(found.instants), lines < 3 ? lines == 2 : (lines - 1) / 2) << lines;
    if (found.instants == 0) continue;
    EXPECT_EQ(recover(found), folder_ / "trajectory.recovered.csv");
    const std::string saved = bytes_of(folder_ / "trajectory.recovered.csv");
    const std::string comment = saved.substr(0, saved.find('\n') + 1);
    EXPECT_THAT(comment, testing::StartsWith("# ends early: recovered from trajectory.csv.unfinished"));
    EXPECT_TRUE(whole.starts_with(saved.substr(comment.size())));
    const std::string saved_energy = bytes_of(folder_ / "energy.recovered.csv");
    EXPECT_EQ(std::count(saved_energy.begin(), saved_energy.end(), '\n'), 2 + std::int64_t(found.instants));
  }
  EXPECT_EQ(bytes_of(energy), ledger) << "what is whole is not touched";
}

TEST_F(KeptTrajectories, InCsvThatAreDamagedSayWhere) {
  write_cubes(TrajectoryFormat::csv, folder_, 1e-2);
  const fs::path motion = folder_ / "trajectory.csv", energy = folder_ / "energy.csv", events = folder_ / "events.csv";
  const std::string whole = bytes_of(motion), ledger = bytes_of(energy);
  std::string word = whole;
  word.replace(word.find('\n', 1000) + 1, 3, "0,x");
  put(motion, word);
  EXPECT_THAT(in_words(kept(TrajectoryFormat::csv)), HasSubstr("body is 'x"));
  put(motion, whole.substr(0, whole.rfind("\n1,0,") + 1));  // cut between two lines
  EXPECT_THAT(in_words(kept(TrajectoryFormat::csv)),
              testing::AllOf(HasSubstr("damaged, 100 instants until t = 0.99 s"), HasSubstr("same whole instant")));
  put(motion, whole);
  put(energy, ledger.substr(0, ledger.size() - 5));
  EXPECT_THAT(in_words(kept(TrajectoryFormat::csv)), HasSubstr("damaged, 100 instants until t = 0.99 s"));
  put(energy, ledger);
  put(events, "");
  EXPECT_THAT(in_words(kept(TrajectoryFormat::csv)), HasSubstr("damaged, 101 instants until t = 1 s"));
  fs::remove(events);
  EXPECT_THAT(in_words(kept(TrajectoryFormat::csv)), HasSubstr("events.csv: no such file"));
  EXPECT_FALSE(has_trajectory(TrajectoryFormat::csv, folder_));
}

TEST_F(KeptTrajectories, InHdf5ThatAreCutAreNotWholeAndOtherDamageIsSurvived) {
  write_cubes(TrajectoryFormat::hdf5, folder_, 1e-3);
  const fs::path path = folder_ / "trajectory.h5";
  const std::string whole = bytes_of(path);
  std::mt19937 random(6);
  for (int trial = 0; trial < 100; ++trial) {
    put(path, whole.substr(0, random() % whole.size()));
    const KeptTrajectory found = kept(TrajectoryFormat::hdf5);
    ASSERT_EQ(found.condition, Condition::damaged) << in_words(found);
    ASSERT_LE(found.instants, 1001u);
  }
  fs::remove(path);
  for (int trial = 0; trial < 300; ++trial) {
    std::string bytes = whole;
    const std::size_t most = trial % 2 == 0 ? bytes.size() : 6000;  // the parts that are no numbers are at the start
    for (int k = 0; k < 1 + trial % 16; ++k) bytes[random() % most] = static_cast<char>(random() % 256);
    put(unfinished(path), bytes);
    ASSERT_LE(kept(TrajectoryFormat::hdf5).instants, 1001u);
  }
}

TEST_F(KeptTrajectories, SeemWholeUntilAFileIsCutOrOfAnotherKind) {
  for (const auto format : {TrajectoryFormat::csv, TrajectoryFormat::hdf5}) {
    EXPECT_FALSE(seems_whole(format, folder_));
    write_cubes(format, folder_, 1e-3);
    EXPECT_TRUE(seems_whole(format, folder_));
    for (const std::string& name : trajectory_files(format)) {
      const fs::path path = folder_ / name;
      const std::string whole = bytes_of(path);
      for (const std::size_t length : {std::size_t(0), std::size_t(3), whole.size() / 2, whole.size() - 1}) {
        put(path, whole.substr(0, length));
        EXPECT_FALSE(seems_whole(format, folder_)) << name << " of " << length << " bytes";
      }
      if (name != "events.csv") {
        put(path, "this is a text\n");
        EXPECT_FALSE(seems_whole(format, folder_)) << name;
      }
      if (name == "trajectory.csv") {
        put(path, whole.substr(0, whole.rfind("\n1,0,") + 1));
        EXPECT_FALSE(seems_whole(format, folder_)) << "cut between two lines";
      }
      put(path, whole);
      EXPECT_TRUE(seems_whole(format, folder_));
    }
  }
}

TEST_F(KeptTrajectories, OfTheOtherFormatThatAreUnfinishedAreRemovedByTheNextRun) {
  fs::create_directories(folder_);
  put(folder_ / "trajectory.h5.unfinished", "cut");
  put(folder_ / "energy.csv.unfinished", "t_s");
  write_cubes(TrajectoryFormat::csv, folder_, 1e-2);
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename());
  EXPECT_THAT(names, testing::UnorderedElementsAre("trajectory.csv", "energy.csv", "events.csv"));
}

}  // namespace
}  // namespace polhode::study::kept_trajectory_test
