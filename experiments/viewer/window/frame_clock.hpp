// SPDX-License-Identifier: BSD-3-Clause
// Time between two frames, Δt = t_current − t_previous, as in the engine slides.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <utility>

namespace polhode::viewer::inline window {

class FrameClock {
 public:
  /// `now`: s, of any monotonic clock.
  explicit FrameClock(std::function<double()> now = steady_seconds) : now_(std::move(now)) {}

  /// Time (s) since the previous call; 0 at the first call.
  double tick() {
    const double current = now_(), previous = previous_.value_or(current);
    previous_ = current;
    return std::max(current - previous, 0.0);
  }

  static double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

 private:
  std::function<double()> now_;
  std::optional<double> previous_;
};

}  // namespace polhode::viewer::window
