// SPDX-License-Identifier: BSD-3-Clause
// Passes the latest view of a session from the simulation's thread to the window's thread, which does not wait for the
// simulation.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <utility>

#include "experiments/viewer/session/session.hpp"

namespace polhode::viewer::inline session {

class ViewPublisher {
 public:
  /// Returns the latest view to the window's thread and requests the next one, which is made after the next step.
  std::shared_ptr<const View> latest() {
    wanted_ = true;
    const std::lock_guard lock(mutex_);
    return view_;
  }

  // The following functions are for the simulation's thread.

  /// Marks the latest view as outdated.
  void outdate() { outdated_ = true; }
  bool outdated() const { return outdated_; }
  /// True if the window has requested a view since the last call.
  bool take_wanted() { return wanted_.exchange(false); }
  void publish(std::shared_ptr<const View> view) {
    outdated_ = false;
    const std::lock_guard lock(mutex_);
    view_ = std::move(view);
  }

 private:
  std::mutex mutex_;
  std::shared_ptr<const View> view_;
  std::atomic<bool> wanted_{false};
  bool outdated_ = true;
};

}  // namespace polhode::viewer::session
