// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/process/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace polhode::study::inline process {

Progress::Progress(std::string name, std::size_t runs)
    : name_(std::move(name)), runs_(runs), terminal_(isatty(STDERR_FILENO) != 0) {}

bool Progress::is_due() const {
  const double pause = terminal_ ? 0.1 : 10;  // s
  return std::chrono::duration<double>(Clock::now() - last_).count() >= pause;
}

void Progress::report(std::size_t runs_done, double share, std::optional<double> seconds_left) {
  last_ = Clock::now();
  const std::string left =
      seconds_left ? "about " + duration_text(*seconds_left) + " left" : std::string("estimating the time left");
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

}  // namespace polhode::study::process
