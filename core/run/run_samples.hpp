// SPDX-License-Identifier: BSD-3-Clause
// What the drivers of single runs and of ensembles share: how samples go to an observer, and how an end is told.
#pragma once

#include <span>
#include <string>

#include "core/run/simulate.hpp"

namespace polhode {

/// Largest number of steps in one batch that is sampled.
inline constexpr std::int64_t longest_batch = 64;

/// How many samples were taken: fewer than all when the run is to end as diverged at the next one, because of `why`.
struct TakenSamples {
  std::size_t count = 0;
  const char* why = nullptr;
};
/// Hands the finite ones to the observer.
TakenSamples hand_over(std::span<const Sample> samples, Observer& observer);

/// Index of the first step after step k at whose end the observer is due to receive the full state. Step n ends at
/// t0 + n dt (s).
std::int64_t step_of_next_state(const Observer& observer, double t0, double dt, std::int64_t k);

/// "… at t = 1.25 s".
std::string at_time(std::string what, double t);

}  // namespace polhode
