// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/workers.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "experiments/study/progress.hpp"

namespace polhode::study {
namespace {

constexpr std::chrono::milliseconds between_commits{80};

/// The thread that commits finished runs to the store and reports the progress.
class Keeper {
 public:
  Keeper(const std::string& name, std::size_t runs, double cost, Store& store, std::atomic<bool>& stop,
         std::map<std::string, RunResult>& results)
      : store_(store), stop_(stop), results_(results), progress_(name, runs, cost), thread_([this] { loop(); }) {}

  void add(RunRecord record, double cost) {
    const std::lock_guard lock(mutex_);
    pending_.push_back(std::move(record));
    cost_done_ += cost;
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
  void loop() {
    for (bool last = false; !last;) {
      std::vector<RunRecord> records;
      double cost = 0;
      {
        std::unique_lock lock(mutex_);
        wake_.wait_for(lock, between_commits, [this] { return finished_; });
        last = finished_;
        records.swap(pending_);
        cost = cost_done_;
      }
      keep(records);
      progress_.report(done_, cost);
    }
  }

  void keep(std::vector<RunRecord>& records) {
    if (records.empty() || failure_) return;
    try {
      store_.keep(records);
      done_ += records.size();
      for (RunRecord& r : records) results_[r.id] = std::move(r.result);
    } catch (...) {
      failure_ = std::current_exception();
      stop_ = true;
    }
  }

  Store& store_;
  std::atomic<bool>& stop_;
  std::map<std::string, RunResult>& results_;
  Progress progress_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<RunRecord> pending_;
  double cost_done_ = 0;
  std::size_t done_ = 0;
  bool finished_ = false;
  std::exception_ptr failure_;
  std::thread thread_;  // must be the last member: the thread uses all others
};

}  // namespace

void run_all(const std::string& name, std::vector<Batch> batches,
             const std::function<std::vector<RunResult>(const Batch&)>& work, int jobs, Store& store,
             std::atomic<bool>& stop, std::map<std::string, RunResult>& results) {
  // Longest batches first, so that all cores finish at about the same time.
  std::stable_sort(batches.begin(), batches.end(),
                   [](const Batch& a, const Batch& b) { return a.front()->cost > b.front()->cost; });
  double cost = 0;
  std::size_t runs = 0;
  for (const Batch& batch : batches) {
    runs += batch.size();
    for (const PlannedRun* run : batch) cost += run->cost;
  }
  Keeper keeper(name, runs, cost, store, stop, results);
  std::atomic<std::size_t> next{0};
  std::mutex failure_mutex;
  std::exception_ptr failure;
  const auto worker = [&](int) {
    for (std::size_t i = next++; i < batches.size() && !stop; i = next++) {
      try {
        std::vector<RunResult> done = work(batches[i]);
        for (std::size_t k = 0; k < done.size(); ++k) {
          const PlannedRun& run = *batches[i][k];
          if (done[k].status != "interrupted") keeper.add({run.id, run.config, std::move(done[k])}, run.cost);
        }
      } catch (...) {
        const std::lock_guard lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        stop = true;
      }
    }
  };
  const int cores = std::max(1, jobs > 0 ? jobs : static_cast<int>(std::thread::hardware_concurrency()));
  const int count = std::min(cores, static_cast<int>(std::min<std::size_t>(batches.size(), 4096)));
  if (count <= 1) {
    worker(0);
  } else {
    tbb::task_arena arena(count);
    arena.execute([&] { tbb::parallel_for(0, count, worker); });
  }
  keeper.finish();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace polhode::study
