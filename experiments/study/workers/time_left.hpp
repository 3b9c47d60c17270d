// SPDX-License-Identifier: BSD-3-Clause
// Estimates the time that a study still needs, from the work of its runs and the times of those that are done.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>

namespace polhode::study::inline workers {

/// Runs of one kind take times in proportion to their work; each kind has a rate of its own. Work is in any unit.
class TimeLeft {
 public:
  /// Work under way at one worker.
  struct UnderWay {
    std::string kind;
    double work = 0;
    double share = 0;    ///< part of the work that is done, 0 to 1
    double seconds = 0;  ///< time since its start, s
  };

  /// Adds work to be done.
  void add(const std::string& kind, double work);
  /// Records that work that was added is done, and the time that one worker took for it (s).
  void done(const std::string& kind, double work, double seconds);

  /// Time until all work is done by so many workers, s; nothing if no work is known to have been done. A kind without
  /// finished work has the rate of its work under way, or else the mean rate of all others.
  std::optional<double> seconds(std::span<const UnderWay> under_way, std::size_t workers) const;

  /// Share of the work that is done, finished or under way, 0 to 1, in time.
  double share(std::span<const UnderWay> under_way) const;

 private:
  struct Kind {
    double work = 0;     ///< all of it
    double done = 0;     ///< finished
    double seconds = 0;  ///< time of finished work, s
  };
  /// Seconds per unit of work.
  struct Rates {
    std::map<std::string, double> known;
    double others = 0;
    double of(const std::string& kind) const;
  };
  std::optional<Rates> rates(std::span<const UnderWay> under_way) const;

  std::map<std::string, Kind> kinds_;
};

}  // namespace polhode::study::workers
