// SPDX-License-Identifier: BSD-3-Clause
// What the runs of a study share about the true motion: the scales of its drifts and, with --reference, a reference
// motion. There is one of each for each variant of a scenario and each duration, made when the first run needs it and
// let go after the last. Like the exact motion, both are of the full equations, whether a run leaves the gyroscopic
// term out or not.
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
  std::shared_ptr<const ReferenceMotion>
      reference;  ///< null unless the run asks for one and no exact motion stands for it
};

class References {
 public:
  References() = default;
  References(const References&) = delete;
  References& operator=(const References&) = delete;

  /// Announces a run, so that what it shares is kept until it has asked for it. Cheap.
  void expect(const RunConfig& config, const Scenario& scenario);

  /// From any thread; whoever comes while it is being made waits. Incomplete when `stop` is set meanwhile.
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

}  // namespace polhode::study
