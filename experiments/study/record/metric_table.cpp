// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/record/metric_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline record {
namespace {

using Runs = Metric::Runs;

/// The 95 % confidence interval of the drift exponent: "0.998 … 1.004"; empty if it is absent.
std::string exponent_interval(const RunResult& r) {
  if (!r.drift_exponent_low || !r.drift_exponent_high) return "";
  return fmt::format("{:.3f} … {:.3f}", *r.drift_exponent_low, *r.drift_exponent_high);
}

/// The class of the energy drift, or "undecided (try 120 s)" with the duration that would decide it.
std::string class_and_duration(const RunResult& r) {
  if (r.drift_class.empty() || !r.drift_decided_after) return r.drift_class.empty() ? "-" : r.drift_class;
  return fmt::format("{} (try {} s)", r.drift_class, number(*r.drift_decided_after, 2));
}

std::vector<Metric> all_metrics() {
  using R = RunResult;
  using C = ContactMeasures;
  using J = JointMeasures;
  return {
      // Outcome of the run; judge has its own columns for it.
      {.column = "status",
       .member = &R::status,
       .words = {"ok", "diverged", "failed"},
       .meaning = "ok, diverged, failed or refused",
       .label = "status",
       .in_summary = true,
       .table_rank = 0,
       .terminal_label = "status",
       .in_scores = false},
      {.column = "message", .member = &R::message, .meaning = "reason of a status other than ok", .in_scores = false},
      {.column = "steps",
       .member = &R::steps,
       .meaning = "number of steps",
       .label = "steps",
       .table_rank = 7,
       .tex = "Steps",
       .in_scores = false},
      {.column = "rhs_evaluations",
       .member = &R::evaluations,
       .meaning = "number of evaluations of the right-hand side",
       .label = "evaluations",
       .table_rank = 7,
       .tex = "Evaluations",
       .in_scores = false},

      // Energy: drift_meter.hpp, motion_scales.hpp; class of the energy drift: drift_class.hpp.
      {.column = "energy_initial_J",
       .member = &R::energy_initial,
       .meaning = "total energy at the start",
       .unit = "J",
       .table_rank = 6,
       .tex = "EnergyInitial"},
      {.column = "energy_scale_J",
       .member = &R::energy_scale,
       .meaning = "scale of relative energy drifts: largest kinetic energy, or change of potential energy",
       .unit = "J",
       .table_rank = 3,
       .tex = "EnergyScale",
       .in_scores = false},
      {.column = "energy_drift_max_J",
       .member = &R::energy_drift_max,
       .meaning = "ledger: kinetic + potential - work of non-conservative forces + energy lost in contact - energy "
                  "injected by projection",
       .listed_as = "energy_drift_*",
       .label = "largest energy drift",
       .unit = "J",
       .least_is_best = true,
       .table_rank = 2,
       .tex = "EnergyDriftMaxJ",
       .in_scores = false},
      {.column = "energy_round_off_J",
       .member = &R::energy_round_off,
       .meaning = "largest energy drift that rounding alone can explain",
       .label = "rounding of the energy",
       .unit = "J",
       .table_rank = 3,
       .in_scores = false},
      {.column = "energy_drift_max_rel",
       .member = &R::energy_drift_max_rel,
       .listed_with = "energy_drift_max_J",
       .label = "largest energy drift",
       .unit = "relative",
       .least_is_best = true,
       .in_summary = true,
       .table_rank = 1,
       .terminal_label = "energy drift",
       .tex = "EnergyDriftMax",
       .judge_label = "energy drift"},
      {.column = "energy_drift_final_rel",
       .member = &R::energy_drift_final_rel,
       .listed_with = "energy_drift_max_J",
       .label = "final energy drift",
       .unit = "relative",
       .table_rank = 4,
       .tex = "EnergyDriftFinal"},
      {.column = "energy_drift_rate_W",
       .member = &R::energy_drift_rate,
       .meaning = "least-squares slope of the drift, and half its 95 % confidence interval",
       .listed_as = "energy_drift_rate_*",
       .list_rank = 1,
       .label = "energy drift rate",
       .unit = "W",
       .table_rank = 4,
       .tex = "EnergyDriftRate",
       .judge_label = "drift rate"},
      {.column = "drift_class",
       .member = &R::drift_class,
       .words = {"", "round-off", "jumps", "saturated", "bounded", "random walk", "sublinear", "linear", "quadratic",
                 "faster", "undecided"},
       .meaning = "by that exponent: bounded, random walk or sublinear, linear, quadratic, faster; round-off,\n"
                  "saturated, jumps (at impacts alone), undecided, with",
       .list_rank = 4,
       .label = "class of the drift",
       .in_summary = true,
       .terminal_label = "its class",
       .terminal_cell = class_and_duration,
       .judge_label = "its class"},
      {.column = "energy_drift_rate_ci_W",
       .member = &R::energy_drift_rate_ci,
       .listed_with = "energy_drift_rate_W",
       .label = "±",
       .unit = "W",
       .table_rank = 4,
       .tex = "EnergyDriftRateInterval",
       .judge_label = "±"},
      {.column = "drift_exponent",
       .member = &R::drift_exponent,
       .meaning = "p of |drift| ~ t^p, oscillations set aside, and its 95 % confidence interval",
       .listed_as = "drift_exponent*",
       .list_rank = 3,
       .label = "exponent of its growth",
       .tex = "DriftExponent",
       .judge_label = "p"},
      {.column = "drift_exponent_low",
       .member = &R::drift_exponent_low,
       .listed_with = "drift_exponent",
       .label = "95 % interval",
       .cell = exponent_interval,
       .tex = "DriftExponentLow",
       .judge_label = "95 %"},
      {.column = "drift_exponent_high",
       .member = &R::drift_exponent_high,
       .listed_with = "drift_exponent",
       .tex = "DriftExponentHigh"},
      {.column = "drift_decided_after_s",
       .member = &R::drift_decided_after,
       .meaning = "the duration that would decide it, by estimate",
       .list_rank = 4,
       .label = "class decided after",
       .unit = "s",
       .in_scores = false},

      // Other invariants: drift_meter.hpp.
      {.column = "linear_momentum_drift_max_rel",
       .member = &R::linear_momentum_drift_max_rel,
       .meaning = "|P - P0| over |P0|, where the forces conserve it",
       .listed_as = "linear_momentum_*",
       .label = "linear momentum drift",
       .unit = "relative",
       .least_is_best = true,
       .in_summary = true,
       .tex = "LinearMomentumDriftMax",
       .judge_label = "linear momentum"},
      {.column = "angular_momentum_drift_max_rel",
       .member = &R::angular_momentum_drift_max_rel,
       .meaning = "|L - L0| over |L0|: one body about its mass centre or pivot, several about the origin",
       .listed_as = "angular_momentum_*",
       .label = "angular momentum drift",
       .unit = "relative",
       .least_is_best = true,
       .in_summary = true,
       .terminal_label = "ang. momentum",
       .tex = "AngularMomentumDriftMax",
       .judge_label = "angular momentum"},
      {.column = "invariant_drifts_max_rel",
       .member = &R::invariant_drift_max_rel,
       .meaning = "each further invariant that a scenario declares, over its scale",
       .listed_as = "<invariant>_*",
       .label = "drift",
       .unit = "relative",
       .least_is_best = true,
       .in_summary = true,
       .tex = "DriftMax"},
      {.column = "orientation_defect_max",
       .member = &R::orientation_defect_max,
       .meaning = "| |q| - 1 |, or the Frobenius norm of R^T R - 1",
       .label = "orientation defect",
       .unit = "1",
       .least_is_best = true,
       .in_summary = true,
       .terminal_label = "defect",
       .tex = "OrientationDefectMax",
       .judge_label = "orientation defect"},

      // Errors against the exact motion or a reference: drift_meter.hpp, polhode_error.hpp.
      {.column = "position_error_max_m",
       .member = &R::position_error_max,
       .meaning = "distance from the exact mass centre, or with --reference from a proven reference",
       .label = "position error",
       .unit = "m",
       .least_is_best = true,
       .in_summary = true,
       .tex = "PositionErrorMax",
       .judge_label = "position error"},
      {.column = "attitude_error_max_rad",
       .member = &R::attitude_error_max,
       .meaning = "angle between the attitude and the exact one",
       .label = "attitude error",
       .unit = "rad",
       .least_is_best = true,
       .in_summary = true,
       .terminal_label = "attitude rad",
       .tex = "AttitudeErrorMax",
       .judge_label = "attitude error"},
      {.column = "angular_velocity_error_max_rel",
       .member = &R::angular_velocity_error_max_rel,
       .meaning = "|w - w exact| over |w0|",
       .listed_as = "angular_velocity_error_*",
       .label = "angular velocity error",
       .unit = "relative",
       .least_is_best = true,
       .tex = "AngularVelocityErrorMax",
       .judge_label = "angular velocity error"},
      {.column = "polhode_phase_error_max_s",
       .member = &R::polhode_phase_error_max,
       .meaning = "of one free body: how far its momentum is ahead along the exact polhode, s and rad",
       .listed_as = "polhode_phase_error_*",
       .label = "along the polhode",
       .unit = "s",
       .least_is_best = true,
       .tex = "PolhodePhaseErrorMax",
       .judge_label = "along the polhode"},
      {.column = "polhode_phase_error_max_rad",
       .member = &R::polhode_phase_error_max_rad,
       .listed_with = "polhode_phase_error_max_s",
       .unit = "rad"},
      {.column = "polhode_off_error_max_rel",
       .member = &R::polhode_off_error_max_rel,
       .meaning = "and its distance from that polhode, over |L|",
       .listed_as = "polhode_off_error_*",
       .label = "off the polhode",
       .unit = "relative",
       .least_is_best = true,
       .tex = "PolhodeOffErrorMax",
       .judge_label = "off it"},

      // Uncertainty of the reference; infinite if the reference could not be computed over the whole motion.
      {.column = "position_reference_m",
       .member = &R::position_reference,
       .runs = Runs::with_reference,
       .may_be_infinite = true,
       .meaning = "uncertainty of the reference that these errors were measured against",
       .listed_as = "*_reference_*",
       .unit = "m"},
      {.column = "attitude_reference_rad",
       .member = &R::attitude_reference,
       .runs = Runs::with_reference,
       .may_be_infinite = true,
       .listed_with = "position_reference_m",
       .unit = "rad"},
      {.column = "angular_velocity_reference_rel",
       .member = &R::angular_velocity_reference_rel,
       .runs = Runs::with_reference,
       .may_be_infinite = true,
       .listed_with = "position_reference_m",
       .unit = "relative"},

      // Contact: contact_meter.hpp.
      {.column = "first_impact_s",
       .member = &C::first_impact,
       .runs = Runs::with_contact,
       .meaning = "with contact: when the first impact was, and",
       .list_rank = 2,
       .label = "first impact",
       .unit = "s"},
      {.column = "impact_loss_J",
       .member = &C::impact_loss,
       .runs = Runs::with_contact,
       .meaning = "what the ledger has lost to impacts and friction, and what undoing penetration put in",
       .listed_as = "impact_loss_J ...",
       .list_rank = 2,
       .label = "lost to impacts",
       .unit = "J"},
      {.column = "friction_loss_J",
       .member = &C::friction_loss,
       .runs = Runs::with_contact,
       .listed_with = "impact_loss_J",
       .label = "lost to friction",
       .unit = "J"},
      {.column = "penetration_J",
       .member = &C::penetration_energy,
       .runs = Runs::with_contact,
       .listed_with = "impact_loss_J",
       .label = "put in by undoing depth",
       .unit = "J"},
      {.column = "energy_rise_max_J",
       .member = &C::energy_rise_max,
       .runs = Runs::with_contact,
       .meaning = "largest rise of kinetic + potential - work above an earlier value",
       .list_rank = 2,
       .label = "energy rises by",
       .unit = "J",
       .least_is_best = true},
      {.column = "energy_change_max_J",
       .member = &C::energy_change_max,
       .runs = Runs::with_contact,
       .meaning = "its largest distance from that at the start",
       .list_rank = 2,
       .unit = "J"},
      {.column = "penetration_max_m",
       .member = &C::penetration_max,
       .runs = Runs::with_contact,
       .meaning = "how deep two bodies were in each other at most, and at the end",
       .listed_as = "penetration_max_m, _end_m",
       .list_rank = 2,
       .label = "deepest",
       .unit = "m",
       .least_is_best = true},
      {.column = "penetration_end_m",
       .member = &C::penetration_end,
       .runs = Runs::with_contact,
       .listed_with = "penetration_max_m",
       .unit = "m"},
      {.column = "displacement_after_2s_max_m",
       .member = &C::displacement_max,
       .runs = Runs::with_contact,
       .meaning = "of a mass centre from where it was after 2 s",
       .list_rank = 2,
       .unit = "m"},
      {.column = "left_place_s",
       .member = &C::left_place,
       .runs = Runs::with_contact,
       .meaning = "when one was a tenth of its body's radius away from where it started",
       .list_rank = 2,
       .unit = "s"},

      // Joints: joint_meter.hpp.
      {.column = "joint_gap_max_m",
       .member = &J::gap_max,
       .runs = Runs::with_joints,
       .meaning = "with joints: largest |g| of their lengths and angles, and |G v| of both, over all instants",
       .listed_as = "joint_gap_max_m, joint_angle_max_rad ...",
       .list_rank = 2,
       .label = "joints open by",
       .unit = "m",
       .least_is_best = true,
       .in_summary = true,
       .terminal_label = "joint gap"},
      {.column = "joint_angle_max_rad",
       .member = &J::angle_max,
       .runs = Runs::with_joints,
       .listed_with = "joint_gap_max_m",
       .label = "joints turn open by",
       .unit = "rad",
       .least_is_best = true},
      {.column = "joint_velocity_max_m_per_s",
       .member = &J::velocity_max,
       .runs = Runs::with_joints,
       .listed_with = "joint_gap_max_m",
       .label = "joints part at",
       .unit = "m/s",
       .least_is_best = true},
      {.column = "joint_rate_max_rad_per_s",
       .member = &J::rate_max,
       .runs = Runs::with_joints,
       .listed_with = "joint_gap_max_m",
       .unit = "rad/s",
       .least_is_best = true},
      {.column = "joint_gap_within_steps_m",
       .member = &J::gap_within,
       .runs = Runs::with_joints,
       .meaning = "the same within steps, by the dense output of the method; empty if it has none",
       .listed_as = "joint_gap_within_steps_m, joint_angle_within_steps_rad ...",
       .list_rank = 2,
       .label = "joints open within steps by",
       .unit = "m",
       .least_is_best = true},
      {.column = "joint_angle_within_steps_rad",
       .member = &J::angle_within,
       .runs = Runs::with_joints,
       .listed_with = "joint_gap_within_steps_m",
       .label = "joints turn open within steps by",
       .unit = "rad",
       .least_is_best = true},
      {.column = "joint_velocity_within_steps_m_per_s",
       .member = &J::velocity_within,
       .runs = Runs::with_joints,
       .listed_with = "joint_gap_within_steps_m",
       .label = "joints part within steps at",
       .unit = "m/s",
       .least_is_best = true},
      {.column = "joint_rate_within_steps_rad_per_s",
       .member = &J::rate_within,
       .runs = Runs::with_joints,
       .listed_with = "joint_gap_within_steps_m",
       .unit = "rad/s",
       .least_is_best = true},
      {.column = "joint_work_J",
       .member = &J::work,
       .runs = Runs::with_joints,
       .meaning = "work of the joints (of their reactions, not zero where drift or Baumgarte's method leaves G v),\n"
                  "and energy injected by projection, at the end",
       .listed_as = "joint_work_J, projection_J",
       .list_rank = 2,
       .label = "work of the joints",
       .unit = "J"},
      {.column = "projection_J",
       .member = &J::projection,
       .runs = Runs::with_joints,
       .listed_with = "joint_work_J",
       .label = "put in by projection",
       .unit = "J"},
      {.column = "joint_rank",
       .member = &J::rank,
       .runs = Runs::with_joints,
       .meaning = "least rank of the equations of the joints, and largest condition of the independent ones",
       .listed_as = "joint_rank, joint_condition_max",
       .list_rank = 2,
       .label = "rank"},
      {.column = "joint_condition_max",
       .member = &J::condition_max,
       .runs = Runs::with_joints,
       .listed_with = "joint_rank"},
      {.column = "nonlinear_iterations",
       .member = &J::iterations,
       .runs = Runs::with_joints,
       .meaning = "with joints: number of iterations in which the method has solved the equations of its steps",
       .list_rank = 2,
       .label = "nonlinear iterations"},
      {.column = "joint_solves",
       .member = &J::solves,
       .runs = Runs::with_joints,
       .meaning = "number of linear systems G M^-1 G^T of the joints that the method and projections have solved",
       .list_rank = 2,
       .label = "systems of joints"},
      {.column = "velocity_error_max_m_per_s",
       .member = &J::speed_error_max,
       .runs = Runs::with_joints,
       .meaning =
           "with joints: largest error of the velocity of a mass centre, of the force and of the torque of a joint,\n"
           "against the exact motion or the reference",
       .listed_as = "velocity_error_max_m_per_s, joint_reaction_error_max_N ...",
       .list_rank = 2,
       .label = "velocity off by",
       .unit = "m/s",
       .least_is_best = true},
      {.column = "joint_reaction_error_max_N",
       .member = &J::reaction_error_max,
       .runs = Runs::with_joints,
       .listed_with = "velocity_error_max_m_per_s",
       .label = "forces of joints off by",
       .unit = "N",
       .least_is_best = true},
      {.column = "joint_reaction_torque_error_max_N_m",
       .member = &J::reaction_torque_error_max,
       .runs = Runs::with_joints,
       .listed_with = "velocity_error_max_m_per_s",
       .label = "torques of joints off by",
       .unit = "N m",
       .least_is_best = true},
  };
}

std::string table_text(const std::optional<double>& x) { return x && std::isfinite(*x) ? number(*x) : ""; }
std::string table_text(std::int64_t n) { return n > 0 ? std::to_string(n) : ""; }
std::string table_text(const std::string& text) { return text; }

template <class Value>
constexpr bool by_invariant = std::is_same_v<Value, std::map<std::string, double>>;

}  // namespace

const std::vector<Metric>& metric_table() {
  static const std::vector<Metric> all = all_metrics();
  return all;
}

const Metric& metric_of_column(const std::string& column) {
  for (const Metric& metric : metric_table()) {
    if (metric.column == column) return metric;
  }
  throw std::logic_error("there is no metric " + column);
}

std::vector<const Metric*> in_table_order(std::span<const Metric> metrics) {
  std::vector<const Metric*> ordered;
  for (const Metric& metric : metrics) ordered.push_back(&metric);
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const Metric* a, const Metric* b) { return a->table_rank < b->table_rank; });
  return ordered;
}

std::vector<std::string> csv_columns(const Metric& metric, const std::vector<std::string>& invariants) {
  if (!std::holds_alternative<std::map<std::string, double> RunResult::*>(metric.member)) return {metric.column};
  std::vector<std::string> columns;
  for (const std::string& invariant : invariants) columns.push_back(invariant + "_drift_max_rel");
  return columns;
}

void add_csv_cells(CsvRow& row, const Metric& metric, const RunResult& result,
                   const std::vector<std::string>& invariants) {
  with_value(metric, result, [&]<class Value>(const Value& value) {
    if constexpr (by_invariant<Value>) {
      for (const std::string& invariant : invariants) {
        const auto found = value.find(invariant);
        row.add(found == value.end() ? std::nullopt : std::optional(found->second));
      }
    } else {
      row.add(value);
    }
  });
}

std::string table_cell(const Metric& metric, const RunResult& result) {
  if (metric.cell) return metric.cell(result);
  std::string text;
  with_value(metric, result, [&]<class Value>(const Value& value) {
    if constexpr (!by_invariant<Value>) text = table_text(value);
  });
  return text;
}

bool is_text(const Metric& metric) {
  return metric.cell || std::holds_alternative<std::string RunResult::*>(metric.member);
}

}  // namespace polhode::study::record
