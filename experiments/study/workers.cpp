// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/workers.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <iterator>
#include <mutex>
#include <thread>

#include "experiments/study/progress.hpp"
#include "experiments/study/time_left.hpp"

namespace polhode::study {
namespace {

constexpr std::chrono::milliseconds between_commits{80};

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double cost_of(const Batch& batch) {
  double cost = 0;
  for (const PlannedRun* run : batch) cost += run->cost;
  return cost;
}

/// Batches of one kind take times in proportion to their cost.
std::string kind_of(const Batch& batch) {
  const RunConfig& config = batch.front()->config;
  return fmt::format("{} {} {} {}", config.integrator, config.scenario, name(config.precision), batch.size() > 1);
}

/// The batch that a worker carries out.
struct Desk {
  const Batch* batch = nullptr;
  Clock::time_point started{};
  std::atomic<double> share{0};
};

/// The thread that commits finished runs to the store and reports the progress.
class Keeper {
 public:
  Keeper(const std::string& name, const std::vector<Batch>& batches, std::size_t workers, const Finish& finish_runs,
         Store& store, std::atomic<bool>& no_more, std::map<std::string, RunResult>& results)
      : finish_runs_(finish_runs),
        store_(store),
        no_more_(no_more),
        results_(results),
        desks_(workers),
        progress_(name, runs_in(batches)) {
    for (const Batch& batch : batches) time_left_.add(kind_of(batch), cost_of(batch));
    thread_ = std::thread([this] { loop(); });
  }

  /// Says that a worker begins a batch. Returns the share of it that is done.
  std::atomic<double>& begin(std::size_t worker, const Batch& batch) {
    const std::lock_guard lock(mutex_);
    Desk& desk = desks_[worker];
    desk.batch = &batch;
    desk.started = Clock::now();
    desk.share = 0;
    return desk.share;
  }

  void add(std::size_t worker, std::vector<RunRecord> records) {
    const std::lock_guard lock(mutex_);
    Desk& desk = desks_[worker];
    time_left_.done(kind_of(*desk.batch), cost_of(*desk.batch), seconds_since(desk.started));
    desk.batch = nullptr;
    std::move(records.begin(), records.end(), std::back_inserter(pending_));
  }

  /// Waits for the last commit; rethrows an exception of the thread.
  void finish() {
    {
      const std::lock_guard lock(mutex_);
      finished_ = true;
    }
    wake_.notify_one();
    thread_.join();
    progress_.finish();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  static std::size_t runs_in(const std::vector<Batch>& batches) {
    std::size_t runs = 0;
    for (const Batch& batch : batches) runs += batch.size();
    return runs;
  }

  void loop() {
    for (bool last = false; !last;) {
      std::vector<RunRecord> records;
      {
        std::unique_lock lock(mutex_);
        wake_.wait_for(lock, between_commits, [this] { return finished_; });
        last = finished_;
        records.swap(pending_);
      }
      keep(records);
      if (progress_.is_due()) report();
    }
  }

  void report() {
    const std::lock_guard lock(mutex_);
    std::vector<TimeLeft::UnderWay> under_way;
    for (const Desk& desk : desks_) {
      if (!desk.batch) continue;
      under_way.push_back({kind_of(*desk.batch), cost_of(*desk.batch), desk.share, seconds_since(desk.started)});
    }
    progress_.report(done_, time_left_.share(under_way), time_left_.seconds(under_way, desks_.size()));
  }

  void keep(std::vector<RunRecord>& records) {
    if (records.empty() || failure_) return;
    try {
      finish_runs_(records);
      store_.keep(records);
      done_ += records.size();
      for (RunRecord& r : records) results_[r.id] = std::move(r.result);
    } catch (...) {
      failure_ = std::current_exception();
      no_more_ = true;
    }
  }

  const Finish& finish_runs_;
  Store& store_;
  std::atomic<bool>& no_more_;
  std::map<std::string, RunResult>& results_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<Desk> desks_;
  TimeLeft time_left_;
  Progress progress_;
  std::vector<RunRecord> pending_;
  std::size_t done_ = 0;
  bool finished_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace

void run_all(const std::string& name, std::vector<Batch> batches, const Work& work, const Finish& finish, int jobs,
             Store& store, std::atomic<bool>& no_more, std::map<std::string, RunResult>& results) {
  // Longest batches first, so that all cores finish at about the same time.
  std::stable_sort(batches.begin(), batches.end(),
                   [](const Batch& a, const Batch& b) { return a.front()->cost > b.front()->cost; });
  const int cores = std::max(1, jobs > 0 ? jobs : static_cast<int>(std::thread::hardware_concurrency()));
  const int count = std::min(cores, static_cast<int>(std::min<std::size_t>(batches.size(), 4096)));
  Keeper keeper(name, batches, static_cast<std::size_t>(std::max(count, 1)), finish, store, no_more, results);
  std::atomic<std::size_t> next{0};
  std::mutex failure_mutex;
  std::exception_ptr failure;
  const auto worker = [&](int number) {
    const auto place = static_cast<std::size_t>(number);
    for (std::size_t i = next++; i < batches.size() && !no_more; i = next++) {
      try {
        std::vector<RunResult> done = work(batches[i], keeper.begin(place, batches[i]));
        std::vector<RunRecord> finished;
        for (std::size_t k = 0; k < done.size(); ++k) {
          const PlannedRun& run = *batches[i][k];
          if (done[k].status != "interrupted") finished.push_back({run.id, run.config, std::move(done[k])});
        }
        keeper.add(place, std::move(finished));
      } catch (...) {
        const std::lock_guard lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        no_more = true;
      }
    }
  };
  if (count <= 1) {
    worker(0);
  } else {
    tbb::task_arena arena(count);
    arena.execute([&] { tbb::parallel_for(0, count, worker, tbb::simple_partitioner()); });
  }
  keeper.finish();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace polhode::study
