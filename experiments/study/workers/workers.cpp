// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/workers/workers.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "core/math/lanes.hpp"
#include "experiments/study/process/progress.hpp"
#include "experiments/study/text/in_order.hpp"
#include "experiments/study/workers/run_queue.hpp"
#include "experiments/study/workers/time_left.hpp"

namespace polhode::study::inline workers {
namespace {

using Clock = std::chrono::steady_clock;

// Ids of runs are in no order: a commit rewrites the pages of their index that it changes, in a large store all of it.
constexpr Clock::duration between_commits = std::chrono::milliseconds{80};
constexpr Clock::duration longest_between_commits = std::chrono::seconds{1};
constexpr int between_by_last = 10;          // time to the next commit / time that the last one took
constexpr std::size_t store_at_once = 2048;  // finished runs that go to the store before that time
constexpr std::size_t most_pending = 4096;   // finished runs in memory; workers wait until some go to the store

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The batch that a worker carries out.
struct Desk {
  bool busy = false;
  std::string kind;
  double cost = 0;
  Clock::time_point started{};
  std::atomic<double> share{0};
};

/// The thread that stores finished runs and reports the progress.
class Keeper {
 public:
  Keeper(const std::string& name, const Plan& plan, const std::vector<std::uint32_t>& runs, std::size_t workers,
         const Work& work, Store& store, std::atomic<bool>& no_more)
      : work_(work), store_(store), no_more_(no_more), desks_(workers), progress_(name, runs.size()) {
    std::vector<double> costs(plan.kinds.size());
    for (const std::uint32_t i : runs) costs[plan.rows[i].kind] += plan.rows[i].cost;
    for (std::size_t kind = 0; kind < costs.size(); ++kind) {
      if (costs[kind] > 0) time_left_.add(plan.kinds[kind], costs[kind]);
    }
    thread_ = std::thread([this] { loop(); });
  }

  /// Marks the beginning of a worker's batch. Returns the share of it that is done.
  std::atomic<double>& begin(std::size_t worker, const std::string& kind, double cost) {
    const std::lock_guard lock(mutex_);
    Desk& desk = desks_[worker];
    desk.busy = true;
    desk.kind = kind;
    desk.cost = cost;
    desk.started = Clock::now();
    desk.share = 0;
    return desk.share;
  }

  /// Receives the finished run of the plan with this number.
  void add(std::uint32_t number, RunRecord&& record) {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [this] { return pending_.numbers.size() < most_pending; });
    pending_.numbers.push_back(number);
    pending_.records.push_back(std::move(record));
    if (pending_.numbers.size() == store_at_once) wake_.notify_one();
  }

  /// Marks the end of a worker's batch.
  void end(std::size_t worker) {
    const std::lock_guard lock(mutex_);
    Desk& desk = desks_[worker];
    time_left_.done(desk.kind, desk.cost, seconds_since(desk.started));
    desk.busy = false;
  }

  /// Waits for the last commit. Returns the numbers of the runs that were committed. Rethrows an exception of the
  /// thread.
  std::vector<std::uint32_t> finish() {
    {
      const std::lock_guard lock(mutex_);
      finished_ = true;
    }
    wake_.notify_one();
    thread_.join();
    progress_.finish();
    if (failure_) std::rethrow_exception(failure_);
    return std::move(committed_);
  }

 private:
  /// Finished runs.
  struct Runs {
    std::vector<std::uint32_t> numbers;  // in the plan
    std::vector<RunRecord> records;
  };

  void loop() {
    Runs runs;  // change places with pending_, so that neither list grows anew each time
    for (bool last = false; !last;) {
      runs.numbers.clear();
      runs.records.clear();
      {
        std::unique_lock lock(mutex_);
        wake_.wait_for(lock, between_commits, [this] { return finished_ || pending_.numbers.size() >= store_at_once; });
        last = finished_;
        std::swap(runs, pending_);
      }
      room_.notify_all();
      keep(runs, last);
      if (progress_.is_due()) report();
    }
  }

  void report() {
    const std::lock_guard lock(mutex_);
    std::vector<TimeLeft::UnderWay> under_way;
    for (const Desk& desk : desks_) {
      if (desk.busy) under_way.push_back({desk.kind, desk.cost, desk.share, seconds_since(desk.started)});
    }
    progress_.report(committed_.size(), time_left_.share(under_way), time_left_.seconds(under_way, desks_.size()));
  }

  /// Stores the runs, and commits what is stored once it is time.
  void keep(Runs& runs, bool last) {
    if (failure_) return;
    try {
      if (!runs.numbers.empty()) add(runs);
      if (keeping_ && (last || Clock::now() >= next_commit_)) commit();
    } catch (...) {
      failure_ = std::current_exception();
      no_more_ = true;
      keeping_.reset();
    }
  }

  void add(Runs& runs) {
    try {
      work_.finish(runs.records);
    } catch (...) {
      if (keeping_) commit();
      throw;
    }
    if (!keeping_) keeping_.emplace(store_);
    keeping_->add(runs.records);
    uncommitted_.insert(uncommitted_.end(), runs.numbers.begin(), runs.numbers.end());
    if (work_.stored) work_.stored(runs.numbers, runs.records);
  }

  void commit() {
    const Clock::time_point start = Clock::now();
    keeping_->commit();
    keeping_.reset();
    committed_.insert(committed_.end(), uncommitted_.begin(), uncommitted_.end());
    uncommitted_.clear();
    const Clock::time_point end = Clock::now();
    next_commit_ = end + std::clamp(between_by_last * (end - start), between_commits, longest_between_commits);
  }

  const Work& work_;
  Store& store_;
  std::atomic<bool>& no_more_;
  std::mutex mutex_;
  std::condition_variable wake_, room_;  ///< the keeper's and the workers'
  std::vector<Desk> desks_;
  TimeLeft time_left_;
  Progress progress_;
  Runs pending_;
  std::vector<std::uint32_t> committed_, uncommitted_;  ///< numbers of the runs in the store
  std::optional<Store::Keeping> keeping_;               ///< what is not yet committed
  Clock::time_point next_commit_ = Clock::now() + between_commits;
  bool finished_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

/// Sorts the runs into batches of equal key, in their order. Runs with an empty key are batches of one.
std::vector<std::vector<std::size_t>> batches_of(const std::vector<PlannedRun>& runs, const Work& work) {
  std::vector<std::vector<std::size_t>> batches;
  std::map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string key = work.key(runs[i]);
    const auto found = known.find(key);
    if (key.empty() || found == known.end()) {
      known[key] = batches.size();
      batches.push_back({i});
    } else {
      batches[found->second].push_back(i);
    }
  }
  return batches;
}

/// One of the threads that carry out runs.
class Worker {
 public:
  Worker(const Plan& plan, const Work& work, Keeper& keeper, std::atomic<bool>& no_more, std::size_t number)
      : plan_(plan), work_(work), keeper_(keeper), no_more_(no_more), number_(number) {}

  /// Carries out these runs, until no more may begin.
  void carry_out(const std::vector<std::uint32_t>& numbers) {
    std::vector<PlannedRun> runs;
    runs.reserve(numbers.size());
    Variants variants;
    for (const std::uint32_t i : numbers) runs.push_back(plan_.run(i, &variants));
    for (const std::vector<std::size_t>& members : batches_of(runs, work_)) {
      if (no_more_) return;
      std::vector<PlannedRun> batch;
      batch.reserve(members.size());
      double cost = 0;
      for (const std::size_t k : members) {
        batch.push_back(std::move(runs[k]));
        cost += plan_.rows[numbers[k]].cost;
      }
      const PlanRow& first = plan_.rows[numbers[members.front()]];
      std::atomic<double>& share = keeper_.begin(number_, plan_.kinds[first.kind], cost);
      work_.carry_out(batch, share, [&](std::size_t k, RunResult&& result) {
        if (result.status == "interrupted") return;
        if (!plan_.rows[numbers[members[k]]].keeps_curves) drop_curves(result);
        keeper_.add(numbers[members[k]], {batch[k].id, batch[k].config, std::move(result)});
      });
      keeper_.end(number_);
    }
  }

 private:
  const Plan& plan_;
  const Work& work_;
  Keeper& keeper_;
  std::atomic<bool>& no_more_;
  std::size_t number_;
};

}  // namespace

std::vector<std::uint32_t> run_all(const std::string& name, const Plan& plan, const std::vector<std::uint32_t>& runs,
                                   const Work& work, int jobs, Store& store, std::atomic<bool>& no_more) {
  if (runs.empty()) return {};
  const auto count = static_cast<int>(std::min({number_of_threads(jobs), runs.size(), std::size_t{4096}}));
  // One run of each kind decides whether others can be carried out together with it.
  std::vector<std::size_t> together(plan.kinds.size());
  for (const std::uint32_t i : runs) {
    std::size_t& most = together[plan.rows[i].kind];
    if (most == 0) most = work.key(plan.run(i)).empty() ? 1 : std::size_t(lane_count);
  }
  Keeper keeper(name, plan, runs, static_cast<std::size_t>(count), work, store, no_more);
  RunQueue queue(plan, runs, static_cast<std::size_t>(count), std::move(together));
  std::mutex failure_mutex;
  std::exception_ptr failure;
  const auto work_on = [&](int number) {
    Worker worker(plan, work, keeper, no_more, static_cast<std::size_t>(number));
    while (!no_more) {
      try {
        if (work.between) work.between();
        const std::vector<std::uint32_t> taken = queue.take();
        if (taken.empty()) return;
        worker.carry_out(taken);
      } catch (...) {
        const std::lock_guard lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        no_more = true;
      }
    }
  };
  if (count <= 1) {
    work_on(0);
  } else {
    tbb::task_arena arena(count);
    arena.execute([&] { tbb::parallel_for(0, count, work_on, tbb::simple_partitioner()); });
  }
  std::vector<std::uint32_t> stored = keeper.finish();
  if (failure) std::rethrow_exception(failure);
  return stored;
}

}  // namespace polhode::study::workers
