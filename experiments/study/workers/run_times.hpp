// SPDX-License-Identifier: BSD-3-Clause
// The times that the runs of a plan will take, found by carrying out some of them for a few milliseconds each.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "experiments/study/plan/plan.hpp"

namespace polhode::study::inline workers {

struct RunTimes {
  std::vector<double> seconds;  ///< time that one worker takes for each run, s, in the order of the runs
  /// Time that the first of the runs which share scales or a reference takes to make them, s; 0 for the other runs.
  std::vector<double> true_motions;
  double known = 0;  ///< share of the sum of these that runs of the same kind were timed for, 0 to 1
};

/// The settings by which runs are timed.
struct Timing {
  bool best_times = false;  ///< short runs are repeated (Experiment::best_times)
  bool in_lanes = false;    ///< runs that can share the lanes of an ensemble do
  std::size_t workers = 1;  ///< runs at a time
  double budget = 0.45;     ///< s
};

/// The wall time that a run had before.
struct KnownTime {
  const PlannedRun* run;
  double seconds;
};

/// Runs are of one kind if they agree in method, scenario, arithmetic, contact algorithms and number of bodies. Of each
/// kind the run of largest and the run of least cost are carried out for a while, and with joints three others, which
/// differ in their stabilization; the most expensive kinds first, until the budget has passed. A kind that was not
/// reached gets the mean rate of those with its method and response, or of all. Of a kind with several known times no
/// run is carried out. Writes no file.
RunTimes run_times(std::span<const PlannedRun* const> runs, std::span<const KnownTime> known, const Timing& timing);

/// Time of a whole run of which a part was carried out in so many seconds, s. `share`: that part, 0 to 1;
/// `share_at_half`: the part that was done after half of these seconds, 0 if it is not known. What is left goes on as
/// the second half did: the cost of a step changes where bodies meet or come to rest.
double time_of_whole(double seconds, double share, double share_at_half);

/// Time of a part of a contact run whose bodies may have fallen and not yet rested, s. `seen`: what the part took;
/// `settled`: what it would take at the rate of bodies at rest. The geometric mean where that is more, since larger
/// heaps fall for longer.
double time_of_falling(double seen, double settled);

/// Time of `runs` runs with so many workers, s, from the times of all of them or of a choice. All runs together need at
/// most `true_motions` different true motions. Each of these is made once, so their time does not grow with the runs.
double time_of_all(const RunTimes& times, double runs, double true_motions, std::size_t workers);

/// Time until so many workers have carried out runs that take these times (s), begun in this order, s.
double time_of_workers(std::span<const double> seconds, std::size_t workers);

}  // namespace polhode::study::workers
