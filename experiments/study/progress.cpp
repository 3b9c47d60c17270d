// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace polhode::study {

Progress::Progress(std::string name, std::size_t runs, double cost)
    : name_(std::move(name)), runs_(runs), cost_(cost), terminal_(isatty(STDERR_FILENO) != 0) {}

void Progress::report(std::size_t runs_done, double cost_done) {
  const auto now = Clock::now();
  const double elapsed = std::chrono::duration<double>(now - started_).count();
  if (std::chrono::duration<double>(now - last_).count() < (terminal_ ? 0.1 : 10.0)) return;
  last_ = now;
  const double share = cost_ > 0 ? cost_done / cost_ : 1;
  std::string left = "estimating the time left";
  if (share > 0.01) left = "about " + duration_text(elapsed * (1 - share) / share) + " left";
  const std::string line = fmt::format("{}: {} of {} runs, {:.0f} %, {}", name_, runs_done, runs_, 100 * share, left);
  if (terminal_) fmt::print(stderr, "\r{}\x1b[K", line);
  else fmt::print(stderr, "{}\n", line);
  std::fflush(stderr);
  printed_ = true;
}

void Progress::finish() {
  if (terminal_ && printed_) fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
}

std::string duration_text(double seconds) {
  const auto s = static_cast<long long>(std::ceil(seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
}

}  // namespace polhode::study
