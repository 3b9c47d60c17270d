// SPDX-License-Identifier: BSD-3-Clause
// The runs of a study sorted into curves: runs that differ in nothing but the step, or the tolerance.
//
// Figures, tables and the report all speak of the same three things: a case (which motion: scenario, varied keys, how
// long), a variant (how it is written down: formulation, normalisation, precision) and a method.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline curves {

struct Case {
  std::string scenario;
  std::vector<std::string>
      details;                ///< what tells it from other cases of the scenario: "body.0.mass = 2", "t_end = 5 s"
  std::string label() const;  ///< on one line
};

struct Curve {
  std::size_t case_index = 0;
  std::size_t variant_index = 0;
  std::size_t method_index = 0;
  bool adaptive = false;  ///< its runs differ in the tolerance, otherwise in the step
  double motion_size = std::numeric_limits<double>::infinity();  ///< m; infinite where it is not known
  std::vector<const RunRecord*> runs;                            ///< largest step or loosest tolerance first
};

/// Points into the records of the study, which must outlive it.
struct Grouping {
  std::vector<std::string> methods;  ///< in the catalogue's order: a method has one colour in all figures
  std::vector<Case> cases;           ///< in the order of the runs, like the rest
  std::vector<std::string>
      variants;  ///< what tells them apart: "matrix, gyroscopic off"; empty text where nothing does
  std::vector<Curve> curves;

  /// "rk4", or "rk4 (matrix)" where there are variants.
  std::string label(const Curve& curve) const;
};

Grouping group(const StudyView& study);

/// A number of a run's result, as figures and sentences name it.
struct Quantity {
  std::string column;    ///< of runs.csv
  std::string words;     ///< "energy drift"
  std::string axis;      ///< label of an axis, with its unit
  std::string unit;      ///< behind a number in a sentence: " rad"
  double round_off = 0;  ///< a value below this is round-off whatever the number of steps
  bool bounded = true;   ///< a value of 1 or more says that the motion is lost: relative drifts, defects, angles
  std::function<std::optional<double>(const RunResult&)> of;
  /// The level of round-off where a run tells it itself; may be empty.
  std::function<std::optional<double>(const RunResult&)> round_off_of{};
};
namespace quantity {
Quantity energy_drift();
Quantity linear_momentum_drift();
Quantity angular_momentum_drift();
Quantity orientation_defect();
Quantity position_error();
Quantity attitude_error();
Quantity invariant_drift(const std::string& name);
}  // namespace quantity

/// The step, or the tolerance of an adaptive method; absent in a run that has neither.
std::optional<double> abscissa(const RunRecord& run);
/// "dt = 0.01 s" or "tolerance = 1e-8".
std::string step_label(const RunRecord& run);
/// The method with its step: "rk4 at dt = 0.01 s".
std::string run_label(const Grouping& grouping, const Curve& curve, const RunRecord& run);

bool completed(const RunRecord& run);    ///< status ok
bool ended_early(const RunRecord& run);  ///< it started and did not reach its end: diverged or failed
/// The quantity if the run was completed and the number is finite.
std::optional<double> value(const RunRecord& run, const Quantity& quantity);
/// In some completed run.
bool is_measured(const Curve& curve, const Quantity& quantity);
/// That number as tables and sentences print it; empty where there is none.
std::string printed(const RunRecord& run, const Quantity& quantity);

/// The relative drift below which rounding alone may stand: 16 ε √steps, a random walk of rounding errors. Of the
/// energy what the run says itself (energy_round_off), where it does.
double round_off_level(const RunRecord& run);
double round_off_level(const RunRecord& run, const Quantity& quantity);

/// From this value on the motion is lost, and which of two values is the larger is chance: angles are wrapped. 1 rad of
/// an attitude, the size of the motion of a position, 1 of what is relative.
double lost_level(const Curve& curve, const Quantity& quantity);
/// The run ended and its value is below that.
bool follows(const RunRecord& run, const Curve& curve, const Quantity& quantity);
/// The run ended, and its attitude, or its position, is known to be lost.
bool off_the_motion(const RunRecord& run, const Curve& curve);

}  // namespace polhode::study::report
