// SPDX-License-Identifier: BSD-3-Clause
// True motions shared by the runs of a study: the scales of drifts and, with --reference, a reference motion. There is
// one of each for each variant of a scenario and each duration, computed for the first run that needs it and released
// after the last. Like the exact motion, both follow the full equations, even for runs without the gyroscopic term.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/exact/reference_motion.hpp"
#include "experiments/study/metrics/motion_scales.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline metrics {

struct TrueMotion {
  MotionScales scales;
  /// Null unless the run requires a reference and the exact motion is not known in full.
  std::shared_ptr<const ReferenceMotion> reference;
};

class References {
 public:
  References() = default;
  References(const References&) = delete;
  References& operator=(const References&) = delete;

  /// Announces runs by number_of() their scenarios. The motions of a scenario that is announced more than once are kept
  /// until of() was called as often, but at most 20 000 motions at a time.
  void expect(std::vector<std::uint64_t> scenarios);

  /// The true motion of the run. Thread-safe: calls wait while another thread computes it. If `stop` is set
  /// meanwhile, without a reference and with incomplete scales.
  TrueMotion of(const RunConfig& config, const Scenario& scenario, const std::atomic<bool>* stop);

  /// Takes these scales as the ones of the motion of an announced scenario from t = 0 to t_end (s): for runs whose time
  /// is taken and whose digits are not read.
  void assume(const Scenario& scenario, double t_end, MotionScales scales);

 private:
  struct Motion {
    std::mutex making;
    std::optional<MotionScales> scales;
    std::shared_ptr<const ReferenceMotion> reference;
  };
  struct Shared {
    std::size_t expected = 0;
    std::map<double, std::shared_ptr<Motion>> motions;  ///< motions by their duration, s
  };
  std::shared_ptr<Motion> motion_of(const Scenario& scenario, double t_end);

  std::mutex mutex_;
  std::unordered_map<std::uint64_t, Shared> shared_;  ///< motions by the number of the scenario
  std::size_t kept_ = 0;                              ///< number of motions
};

}  // namespace polhode::study::metrics
