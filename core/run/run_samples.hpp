// SPDX-License-Identifier: BSD-3-Clause
// Common parts of the loops for single runs and for ensembles: samples for the observer and messages about the end.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "core/run/simulate.hpp"

namespace polhode::inline core::inline run {

/// Largest number of steps in one batch that is sampled.
inline constexpr std::int64_t longest_batch = 64;

/// True, in lanes for each of them, if all numbers of the sample are finite.
template <class T>
auto is_finite(const SampleOf<T>& s) {
  using std::abs;
  const T sum = s.seen.energy() + s.seen.orientation_defect + s.seen.linear_momentum.sum() +
                s.seen.angular_momentum.sum() + s.work;
  return abs(sum) <= T(std::numeric_limits<double>::max());
}

/// The reason why a run ends at a sample that its observer did not accept.
const char* reason_of_end(bool sample_is_finite);

/// Number of samples that were accepted. If it is less than all, the run ends as diverged at the next sample and `why`
/// is the reason; `why` is null otherwise.
struct TakenSamples {
  std::size_t count = 0;
  const char* why = nullptr;
};
/// Passes the samples before the first non-finite one to the observer.
TakenSamples hand_over(std::span<const Sample> samples, Observer& observer);

/// Index of the first step after step k at whose end the observer is due to receive the full state. Step n ends at
/// t0 + n dt (s).
std::int64_t step_of_next_state(const Observer& observer, double t0, double dt, std::int64_t k);

/// Appends the time t (s) to the text: "… at t = 1.25 s".
std::string at_time(std::string what, double t);

}  // namespace polhode::core::run
