// SPDX-License-Identifier: BSD-3-Clause
// The reference motions of a study (--reference): one for each variant of a scenario and each duration, shared by all
// runs of it, made when the first of them needs it and let go after the last. Like the exact motion, it is that of the
// full equations, whether a run leaves the gyroscopic term out or not.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "core/reference_motion.hpp"
#include "experiments/study/run_record.hpp"

namespace polhode::study {

class References {
 public:
  References() = default;
  References(const References&) = delete;
  References& operator=(const References&) = delete;

  /// Announces a run, so that its reference is kept until it has asked for it. Cheap.
  void expect(const RunConfig& config, const Scenario& scenario);

  /// The reference of a run that asks for one (config.reference) and whose exact motion is not known in full; null for
  /// any other. From any thread; whoever comes while it is being made waits. Null too when `stop` is set meanwhile.
  std::shared_ptr<const ReferenceMotion> of(const RunConfig& config, const Scenario& scenario,
                                            const System<double>& system, const std::atomic<bool>* stop);

 private:
  using Key = std::pair<std::string, double>;  ///< canonical text, t_end
  struct Entry {
    std::size_t expected = 0;
    std::mutex making;
    std::shared_ptr<const ReferenceMotion> made;
  };
  static Key key(const RunConfig& config, const Scenario& scenario);

  std::mutex mutex_;
  std::map<Key, std::shared_ptr<Entry>> entries_;
};

}  // namespace polhode::study
