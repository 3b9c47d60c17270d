// SPDX-License-Identifier: BSD-3-Clause
// Channel from the window's thread to the simulation's thread: commands and elapsed wall time. It also lets the threads
// wait for each other.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <vector>

namespace polhode::viewer::inline session {

class CommandQueue {
 public:
  using Command = std::function<void()>;

  /// Commands and wall time received since the last take().
  struct News {
    std::vector<Command> commands;      ///< commands in the order in which they were sent
    double seconds = 0, held_back = 0;  ///< elapsed wall time, and the part of it not to be simulated, s
  };

  // Functions for the window's thread.

  void send(Command command);
  void tick(double seconds, double held_back);
  /// Ends the simulation at its next step.
  void quit();
  /// Elapsed wall time that is still to be simulated, s.
  double behind() const;
  /// Waits until every command was taken and the simulation waits for news.
  void settle();

  // Functions for the simulation's thread.

  bool has_quit() const { return quit_; }
  bool has_news() const { return news_.load(std::memory_order_relaxed); }
  /// Takes all news. behind: wall time that was taken before and is still to be simulated, s. playing: if false, no
  /// wall time remains to be simulated.
  News take(bool playing, double behind);
  /// Waits for news; returns at once if there are some. While it waits, taken wall time counts as simulated.
  void wait();

 private:
  mutable std::mutex mutex_;
  std::condition_variable news_came_, became_idle_;
  News came_;
  double behind_ = 0;  ///< wall time that was taken and is still to be simulated, s
  bool idle_ = false;
  std::atomic<bool> news_{false}, quit_{false};
};

}  // namespace polhode::viewer::session
