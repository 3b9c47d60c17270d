// SPDX-License-Identifier: BSD-3-Clause
// Sorts the runs of a study into curves: runs that differ only in the step, or the tolerance.
//
// Figures, tables and the report use the same three terms: a case (scenario, varied keys, duration), a variant
// (formulation, normalization, precision) and a method.
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
  std::vector<std::string> details;  ///< differences from other cases of the scenario: "body.0.mass = 2", "t_end = 5 s"
  std::string label() const;         ///< the scenario and the details in one line
};

struct Curve {
  std::size_t case_index = 0;
  std::size_t variant_index = 0;
  std::size_t method_index = 0;
  bool adaptive = false;  ///< its runs differ in the tolerance; otherwise in the step
  double motion_size = std::numeric_limits<double>::infinity();  ///< extent of the motion, m; +inf if not known
  std::vector<const RunRecord*> runs;                            ///< largest step or loosest tolerance first
};

/// Points into the records of the study, which must outlive it.
struct Grouping {
  std::vector<std::string> methods;  ///< methods in the catalogue's order: a method has one colour in all figures
  std::vector<Case> cases;           ///< cases in the order of the runs; so are the others
  std::vector<std::string>
      variants;  ///< differences of the variants: "matrix, gyroscopic off"; an empty text if there is one variant
  std::vector<Curve> curves;

  /// "rk4", or "rk4 (matrix)" where there are variants.
  std::string label(const Curve& curve) const;
};

Grouping group(const StudyView& study);

/// A metric (record/metric_table.hpp) that figures and sentences use, with its names there.
struct Quantity {
  std::string column;     ///< column of runs.csv
  std::string words;      ///< "energy drift"
  std::string axis;       ///< label of an axis, with its unit
  std::string unit;       ///< unit after a number in a sentence: " rad"
  double round_off = 0;   ///< values below this are round-off, for any number of steps
  bool bounded = true;    ///< relative drift, defect or angle: a value of 1 or more means that the motion is lost
  bool of_place = false;  ///< a length: the motion is lost where it reaches the extent of the motion
  std::function<std::optional<double>(const RunResult&)> of;
  /// The level of round-off of a run, if its result states one; may be empty.
  std::function<std::optional<double>(const RunResult&)> round_off_of{};
};
namespace quantity {
Quantity energy_drift();
Quantity linear_momentum_drift();
Quantity angular_momentum_drift();
Quantity orientation_defect();
Quantity position_error();
Quantity attitude_error();
Quantity velocity_error();  ///< velocity error of runs with joints
Quantity reaction_error();  ///< error of the forces of joints
Quantity invariant_drift(const std::string& name);
}  // namespace quantity

/// The step, or the tolerance of an adaptive method; absent if the run has neither.
std::optional<double> abscissa(const RunRecord& run);
/// "dt = 0.01 s" or "tolerance = 1e-8".
std::string step_label(const RunRecord& run);
/// Method and step: "rk4 at dt = 0.01 s".
std::string run_label(const Grouping& grouping, const Curve& curve, const RunRecord& run);

bool completed(const RunRecord& run);    ///< status ok
bool ended_early(const RunRecord& run);  ///< diverged or failed
/// The value if the run was completed and the value is finite.
std::optional<double> value(const RunRecord& run, const Quantity& quantity);
/// True if some completed run has a value.
bool is_measured(const Curve& curve, const Quantity& quantity);
/// The value as tables and sentences print it; empty if there is none.
std::string printed(const RunRecord& run, const Quantity& quantity);

/// The relative drift that rounding alone can explain: 16 ε √steps, a random walk of rounding errors. For the energy,
/// the level in the result (energy_round_off), if there is one.
double round_off_level(const RunRecord& run);
double round_off_level(const RunRecord& run, const Quantity& quantity);

/// The level from which the motion is lost (angles are wrapped, so the smaller of two errors is smaller by chance): 1
/// rad for an attitude, the extent of the motion for a position, 1 for relative quantities; +inf for others.
double lost_level(const Curve& curve, const Quantity& quantity);
/// True if the run was completed and its value is below the lost level.
bool follows(const RunRecord& run, const Curve& curve, const Quantity& quantity);
/// True if the run was completed, and its attitude or position is known to be lost.
bool off_the_motion(const RunRecord& run, const Curve& curve);

}  // namespace polhode::study::curves
