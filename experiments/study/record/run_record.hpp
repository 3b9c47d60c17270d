// SPDX-License-Identifier: BSD-3-Clause
// One run of a study: what was asked for and what came out. Tables, figures and the report are made from these alone.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "core/system/formulation.hpp"
#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline record {

enum class Precision { single, dual, extended };
constexpr std::string_view name(Precision p) {
  return p == Precision::single ? "float" : p == Precision::dual ? "double" : "long_double";
}

/// The distance from 1 to the next number of that arithmetic.
constexpr double epsilon(Precision p) {
  return p == Precision::single ? std::numeric_limits<float>::epsilon()
         : p == Precision::dual ? std::numeric_limits<double>::epsilon()
                                : static_cast<double>(std::numeric_limits<long double>::epsilon());
}

/// How the increments of the state are added up.
enum class Summation { plain, compensated };
constexpr std::string_view name(Summation s) { return s == Summation::plain ? "plain" : "compensated"; }

/// The value of a run option in one run; std::monostate: the run has no value of the option.
using OptionValue = std::variant<std::monostate, std::int64_t, double, std::string>;

/// Names of options on demand (RunOption::on_demand): options with a column in runs.csv only in studies that give them.
using NamedOptions = std::set<std::string>;

/// Algorithms of contact detection and response, as names in the catalogues.
struct ContactConfig {
  std::string broad_phase, narrow_phase, response;
  std::string impact_timing;  ///< empty if the response is a force
};

/// The configuration of one run. run_options.hpp names, reads and prints each member.
struct RunConfig {
  std::string scenario;  ///< name
  /// The varied keys of the scenario with this run's values, in the axes' order; an empty value leaves the key as it
  /// is.
  std::vector<Override> varied;
  std::string integrator;
  Formulation formulation;
  bool normalise = false;  ///< --normalize step
  Precision precision = Precision::dual;
  std::optional<int> order;                      ///< absent or 0: the default order of the method
  std::optional<Summation> summation;            ///< absent: plain, and not given by the study
  std::optional<ContactConfig> contact;          ///< absent: the scenario has no contact
  std::optional<double> dt;                      ///< s; fixed-step methods only
  std::optional<double> tolerance;               ///< adaptive methods only
  std::optional<std::int64_t> max_steps;         ///< adaptive methods only; absent: the default of Schedule
  double t_end = 1;                              ///< s
  std::optional<std::int64_t> samples;           ///< absent: observed after every step
  bool reference = false;                        ///< --reference: a reference motion replaces unknown exact solutions
  std::map<std::string, OptionValue> further{};  ///< values of the options without a member here, by option name
};

/// How the run went over time, thinned: each point stands for a stretch of the run and holds the largest value in it.
/// At most 256 points, however long the run.
struct SeriesPoint {
  double t = 0;                          ///< s, where the energy drift of this stretch was largest
  double energy_drift_rel = 0;           ///< signed, the one of largest magnitude
  double linear_momentum_drift_rel = 0;  ///< 0 where that momentum is not conserved
  double angular_momentum_drift_rel = 0;
  double orientation_defect = 0;
};

/// The attitude error at one of at most 64 instants spread over the run.
struct AttitudeError {
  double t = 0;  ///< s
  double error_rad = 0;
};

inline bool is_compensated(const RunConfig& config) { return config.summation == Summation::compensated; }

/// What contact did in a run (contact_meter.hpp). Empty throughout for a run without contact.
struct ContactMeasures {
  std::optional<double> first_impact;                                    ///< s, as events.csv lists them
  std::optional<double> impact_loss, friction_loss, penetration_energy;  ///< J, of the ledger, at the end
  /// J, of kinetic + potential − work of non-conservative forces: its largest rise above an earlier value, and its
  /// largest distance from that at the start. Exactly 0 of an elastic motion without friction.
  std::optional<double> energy_rise_max, energy_change_max;
  std::optional<double> penetration_max, penetration_end;  ///< m, of any two bodies
  std::optional<double> displacement_max;                  ///< m, of any mass centre from where it was after 2 s
  std::optional<double> left_place;  ///< s, when one was first a tenth of its body's radius away from where it started
};

struct RunResult {
  std::string status;    ///< "ok", "diverged", "failed", "refused"
  std::string message;   ///< why, when not ok
  double t_reached = 0;  ///< s
  std::int64_t steps = 0;
  std::int64_t evaluations = 0;
  std::optional<double> energy_initial;          ///< J
  std::optional<double> energy_scale;            ///< J, of the motion (motion_scales.hpp); absent where nothing moves
  std::optional<double> energy_drift_max;        ///< J, max |E − E0|, E from the ledger
  std::optional<double> energy_round_off;        ///< J, up to which a drift can be rounding alone
  std::optional<double> energy_drift_max_rel;    ///< energy_drift_max over energy_scale
  std::optional<double> energy_drift_final_rel;  ///< signed
  std::optional<double> energy_drift_rate;       ///< W, least-squares slope of the drift
  std::optional<double> energy_drift_rate_ci;    ///< W, half its 95 % confidence interval
  std::string drift_class;                       ///< as drift_class.hpp has them; empty where the run is not ok
  std::optional<double>
      drift_exponent;  ///< p of |drift| ~ t^p, and its 95 % confidence interval, of a class that has one
  std::optional<double> drift_exponent_low, drift_exponent_high;
  std::optional<double> drift_decided_after;  ///< s, of "undecided": the duration that would decide, by estimate
  std::optional<double> linear_momentum_drift_max_rel;  ///< absent: the forces do not conserve it
  std::optional<double> angular_momentum_drift_max_rel;
  std::map<std::string, double> invariant_drift_max_rel;  ///< by name, of the scenario's declared invariants
  std::optional<double> orientation_defect_max;
  std::optional<double>
      position_error_max;  ///< m, absent without an exact solution or a proven reference, and of a run that broke off
  std::optional<double> attitude_error_max;  ///< rad
  std::optional<double> angular_velocity_error_max_rel;
  /// Of the momentum in the body of a single free one (polhode_error.hpp): along its polhode and off it.
  std::optional<double> polhode_phase_error_max;      ///< s
  std::optional<double> polhode_phase_error_max_rad;  ///< |ω(0)| times that
  std::optional<double> polhode_off_error_max_rel;
  /// How uncertain the reference is that stood for an unknown exact solution; absent where none was used. An error
  /// that is not a hundred times larger is left out.
  std::optional<double> position_reference;  ///< m
  std::optional<double> attitude_reference;  ///< rad
  std::optional<double> angular_velocity_reference_rel;
  ContactMeasures contact;
  /// Numbers of metrics without a member here, by name of their column (metric_table.hpp).
  std::map<std::string, double> further;
  double seconds = 0;  ///< wall time of the simulation including measurements, s; written to timings.csv only
  std::vector<SeriesPoint> series;
  std::vector<AttitudeError> attitude_errors;  ///< empty without an exact solution, and where a reference stands for it
};

struct RunRecord {
  std::string id;  ///< 16 hexadecimal digits: hash of the resolved scenario, the options and the results version
  RunConfig config;
  RunResult result;
  std::shared_ptr<const Scenario> scenario{};  ///< with the varied keys set; of the runs of a StudyView
};

}  // namespace polhode::study
