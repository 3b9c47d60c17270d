// SPDX-License-Identifier: BSD-3-Clause
// Stores with either journal keep what was committed when the program is killed, and change the journal when they are
// opened where another one is needed.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <thread>

#include "experiments/study/store/store.hpp"
#include "tests/experiments/study/store/loaded.hpp"
#include "tests/experiments/study/store/stored_runs.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::store_tests::journal_test {
namespace {

constexpr std::uint64_t batch = 7;

/// Keeps runs number `first` onwards in another process, until that is killed after a while. Returns the number of runs
/// that it said it had committed.
std::uint64_t kept_until_killed(const std::filesystem::path& folder, Journal journal, std::uint64_t first,
                                std::chrono::microseconds time) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("cannot make a pipe");
  const pid_t child = fork();
  if (child == 0) {
    try {
      Store store(folder, metric_table(), Access::create, journal);
      for (std::uint64_t k = first;; k += batch) {
        std::vector<RunRecord> runs;
        for (std::uint64_t j = k; j < k + batch; ++j) runs.push_back(made_up_run(j));
        store.keep(runs);
        const std::uint64_t done = k + batch;
        if (write(ends[1], &done, sizeof done) != sizeof done) _exit(1);
      }
    } catch (...) {
      _exit(2);
    }
  }
  close(ends[1]);
  std::uint64_t done = first;
  if (read(ends[0], &done, sizeof done) != sizeof done) ADD_FAILURE() << "no commit";  // the first one
  std::this_thread::sleep_for(time);
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  while (read(ends[0], &done, sizeof done) == sizeof done) {
  }
  close(ends[0]);
  return done - first;
}

/// Mode of the journal: 1 rollback journal, 2 write-ahead logging (sqlite.org/fileformat2.html, offset 18).
int mode_of(const std::filesystem::path& folder) {
  char header[20] = {};
  std::ifstream(folder / Store::file_name, std::ios::binary).read(header, sizeof header);
  return header[18];
}

class Journals : public testing::TestWithParam<Journal> {};

TEST_P(Journals, WhatWasCommittedSurvivesAKill) {
  const TemporaryFolder folder;
  std::mt19937 random(5);
  std::uint64_t committed = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const std::chrono::microseconds time(std::uniform_int_distribution<>(0, 20'000)(random));
    committed += kept_until_killed(folder.path(), GetParam(), committed, time);
    const Store store(folder.path(), metric_table(), Access::write, GetParam());
    const auto loaded = load(store);
    EXPECT_TRUE(loaded.damaged.empty());
    ASSERT_GE(loaded.runs.size(), committed);
    ASSERT_LE(loaded.runs.size(), committed + batch);  // the last commit was not said
    committed = loaded.runs.size();
    for (std::uint64_t k = 0; k < committed; ++k) {
      const RunRecord run = made_up_run(k);
      ASSERT_TRUE(loaded.runs.contains(run.id));
      ASSERT_EQ(text_of_result(loaded.runs.at(run.id)), text_of_result(run.result));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Journals, testing::Values(Journal::write_ahead, Journal::rollback));

TEST(Journal, ARollbackJournalNeedsNoSharedMemory) {
  const TemporaryFolder folder;
  Store store(folder.path(), metric_table(), Access::create, Journal::rollback);
  store.keep(made_up_runs(3));
  EXPECT_EQ(mode_of(folder.path()), 1);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "results.sqlite-wal"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "results.sqlite-shm"));
}

TEST(Journal, AStoreThatIsMovedChangesItsJournal) {
  const TemporaryFolder folder;
  const std::uint64_t kept = kept_until_killed(folder.path(), Journal::write_ahead, 0, std::chrono::milliseconds(5));
  ASSERT_TRUE(std::filesystem::exists(folder.path() / "results.sqlite-wal")) << "nothing is left to be moved";
  EXPECT_EQ(mode_of(folder.path()), 2);
  const std::size_t there = Store(folder.path(), metric_table(), Access::write, Journal::rollback).ids().size();
  EXPECT_GE(there, kept);
  EXPECT_EQ(mode_of(folder.path()), 1);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "results.sqlite-wal"));
  const Store back(folder.path(), metric_table(), Access::write, Journal::write_ahead);
  EXPECT_EQ(load(back).runs.size(), there);
  EXPECT_EQ(mode_of(folder.path()), 2);
}

TEST(Journal, AStoreCanBeReadWhileAnotherProgramWrites) {
  const TemporaryFolder folder;
  Store store(folder.path(), metric_table(), Access::create, Journal::write_ahead);
  store.keep(made_up_runs(3));
  const Store reader(folder.path(), metric_table(), Access::read, Journal::write_ahead);
  EXPECT_EQ(load(reader).runs.size(), 3u);
  store.keep(made_up_runs(5));
  EXPECT_EQ(load(reader).runs.size(), 5u);
}

}  // namespace
}  // namespace polhode::study::store_tests::journal_test
