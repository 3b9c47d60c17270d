// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/session/command_queue.hpp"

#include <algorithm>
#include <utility>

namespace polhode::viewer::inline session {

void CommandQueue::send(Command command) {
  {
    const std::lock_guard lock(mutex_);
    came_.commands.push_back(std::move(command));
    news_ = true;
  }
  news_came_.notify_all();
}

void CommandQueue::tick(double seconds, double held_back) {
  {
    const std::lock_guard lock(mutex_);
    came_.seconds += seconds;
    came_.held_back += held_back;
    news_ = true;
  }
  news_came_.notify_all();
}

void CommandQueue::quit() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    news_ = true;
  }
  news_came_.notify_all();
}

double CommandQueue::behind() const {
  const std::lock_guard lock(mutex_);
  return std::max(came_.seconds - came_.held_back, 0.0) + behind_;
}

void CommandQueue::settle() {
  std::unique_lock lock(mutex_);
  became_idle_.wait(lock, [this] { return idle_ && came_.commands.empty() && came_.seconds == 0; });
}

CommandQueue::News CommandQueue::take(bool playing, double behind) {
  const std::lock_guard lock(mutex_);
  news_ = false;
  News taken = std::exchange(came_, {});
  behind_ = playing ? behind + std::max(taken.seconds - taken.held_back, 0.0) : 0;
  return taken;
}

void CommandQueue::wait() {
  std::unique_lock lock(mutex_);
  if (news_) return;
  idle_ = true;
  behind_ = 0;
  became_idle_.notify_all();
  news_came_.wait(lock, [this] { return news_.load(); });
  idle_ = false;
}

}  // namespace polhode::viewer::session
