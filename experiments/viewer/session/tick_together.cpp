// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "experiments/viewer/session/pace.hpp"
#include "experiments/viewer/session/session.hpp"

namespace polhode::viewer::inline session {

void tick_together(std::span<const std::unique_ptr<Session>> sessions, double seconds) {
  double behind = 0;
  for (const auto& session : sessions) behind = std::max(behind, session->behind());
  const double passes = std::clamp(Pace::longest_behind - behind, 0.0, std::max(seconds, 0.0));
  for (const auto& session : sessions) session->tick(seconds, seconds - passes);
}

}  // namespace polhode::viewer::session
