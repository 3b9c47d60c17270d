// SPDX-License-Identifier: BSD-3-Clause
// Error and cost of a run, in units in which different motions can stand in one figure.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "experiments/methods/groups.hpp"
#include "experiments/study/record/study_view.hpp"

namespace polhode::study::methods {

/// Characteristic time of the motion of a run (s): 2π over the characteristic rate, or the duration if it has none.
double characteristic_time(const RunRecord& run);

/// Measures runs. The error of a run is
///   motion: the larger of the attitude error (rad) and the position error over the extent of the motion, or over 1 m
///           if that is not known;
///   impact: the larger of the error of the time of the first impact over the characteristic time, and the drift of the
///           energy over its scale;
///   rest:   the larger of the displacement of a mass centre since 2 s and the depth of penetration, m.
class Ruler {
 public:
  explicit Ruler(const StudyView& study);

  /// Absent if it was not measured, or the run did not end.
  std::optional<double> error(const RunRecord& run) const;

  /// True if the run needs a reference of its first impact that is not among the runs.
  bool lacks_first_impact(const RunRecord& run) const;

 private:
  std::map<std::string, std::optional<double>> first_impacts_;  ///< time of the first impact of each motion, s
  std::map<std::string, double> sizes_;                         ///< extent of each motion, m
};

/// The motion of a run: scenario, varied keys, duration.
std::string motion_of(const RunConfig& config);

}  // namespace polhode::study::methods
