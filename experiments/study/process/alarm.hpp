// SPDX-License-Identifier: BSD-3-Clause
// Stops what workers do when their time is over, and notes how far they were at half of it.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <thread>
#include <vector>

namespace polhode::study::inline process {

class Alarm {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Alarm(std::size_t workers) : watches_(workers) {
    thread_ = std::thread([this] {
      while (!finished_) {
        look();
        std::this_thread::sleep_for(std::chrono::microseconds(100));
      }
    });
  }
  ~Alarm() {
    finished_ = true;
    thread_.join();
  }
  Alarm(const Alarm&) = delete;
  Alarm& operator=(const Alarm&) = delete;

  /// A run of a worker, and how far it came.
  struct Watch {
    Clock::time_point half = never, end = never;
    std::atomic<bool> stop{false};         ///< set at the end
    std::atomic<double> share{0};          ///< part of the run that is done, which the run writes
    std::atomic<double> share_at_half{0};  ///< 0 before
  };

  /// The watch of a worker, set anew: it ends after so many seconds.
  Watch& in(double seconds, std::size_t worker) {
    const std::lock_guard lock(mutex_);
    Watch& watch = watches_[worker];
    watch.stop = false;
    watch.share = watch.share_at_half = 0;
    const auto length = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    const auto now = Clock::now();
    watch.half = now + length / 2;
    watch.end = now + length;
    return watch;
  }

 private:
  void look() {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    for (Watch& watch : watches_) {
      if (now >= watch.half) {
        watch.half = never;
        watch.share_at_half = watch.share.load();
      }
      if (now >= watch.end) watch.stop = true;
    }
  }

  static constexpr Clock::time_point never = Clock::time_point::max();
  std::vector<Watch> watches_;
  std::mutex mutex_;
  std::atomic<bool> finished_{false};
  std::thread thread_;
};

}  // namespace polhode::study::process
