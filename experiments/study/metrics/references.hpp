// SPDX-License-Identifier: BSD-3-Clause
// True motions shared by the runs of a study: the scales of drifts and, with --reference, a reference motion. There is
// one of each for each variant of a scenario and each duration, computed for the first run that needs it and released
// after the last. Like the exact motion, both follow the full equations, even for runs without the gyroscopic term.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

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

  /// Announces a run, so that the motion it shares is kept until of() was called for it. Cheap.
  void expect(const RunConfig& config, const Scenario& scenario);

  /// The true motion of the run. Thread-safe: calls wait while another thread computes it. Incomplete if `stop` is set
  /// meanwhile.
  TrueMotion of(const RunConfig& config, const Scenario& scenario, const std::atomic<bool>* stop);

 private:
  using Key = std::pair<std::string, double>;  ///< canonical text, t_end
  struct Entry {
    std::size_t expected = 0;
    std::mutex making;
    std::optional<MotionScales> scales;
    std::shared_ptr<const ReferenceMotion> reference;
  };
  static Key key(const RunConfig& config, const Scenario& scenario);

  std::mutex mutex_;
  std::map<Key, std::shared_ptr<Entry>> entries_;
};

}  // namespace polhode::study::metrics
