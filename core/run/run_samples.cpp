// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/run_samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace polhode::inline core::inline run {

const char* reason_of_end(bool sample_is_finite) {
  return sample_is_finite ? "the energy grew beyond all bounds" : "the state ceased to be finite";
}

TakenSamples hand_over(std::span<const Sample> samples, Observer& observer) {
  std::size_t finite = 0;
  while (finite < samples.size() && is_finite(samples[finite])) ++finite;
  const std::size_t taken = observer.on_samples(samples.first(finite));
  if (taken == samples.size()) return {taken};
  return {taken, reason_of_end(taken < finite)};
}

std::int64_t step_of_next_state(const Observer& observer, double t0, double dt, std::int64_t k) {
  const double at = std::ceil((observer.next_state() - t0) / dt);
  if (!(at < 9e15)) return std::numeric_limits<std::int64_t>::max();
  return std::max(k + 1, static_cast<std::int64_t>(at));
}

std::string at_time(std::string what, double t) {
  char text[40];
  std::snprintf(text, sizeof text, " at t = %.12g s", t);
  return what += text;
}

}  // namespace polhode::core::run
