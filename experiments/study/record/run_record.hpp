// SPDX-License-Identifier: BSD-3-Clause
// One run of a study: its configuration and its results. Tables, figures and the report are made from these alone.
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

#include "core/run/setting.hpp"
#include "core/system/formulation.hpp"
#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline record {

enum class Precision { single_precision, double_precision, extended_precision };
constexpr std::string_view name(Precision p) {
  return p == Precision::single_precision ? "float" : p == Precision::double_precision ? "double" : "long_double";
}

/// The distance from 1 to the next larger number of the arithmetic.
constexpr double epsilon(Precision p) {
  return p == Precision::single_precision   ? std::numeric_limits<float>::epsilon()
         : p == Precision::double_precision ? std::numeric_limits<double>::epsilon()
                                            : static_cast<double>(std::numeric_limits<long double>::epsilon());
}

/// The form of the additions of increments to the state.
enum class Summation { plain, compensated };
constexpr std::string_view name(Summation s) { return s == Summation::plain ? "plain" : "compensated"; }

/// The value of a run option in one run; std::monostate: the run has no value of the option.
using OptionValue = std::variant<std::monostate, std::int64_t, double, std::string>;

/// Names of options on demand (RunOption::on_demand): options with a column in runs.csv only in studies that give them.
using NamedOptions = std::set<std::string>;

/// Algorithms of contact detection and response, as names in the catalogues.
struct ContactConfig {
  std::string broad_phase, narrow_phase, response;
  std::string impact_timing;  ///< name of the timing; empty if the response is a force
  bool operator==(const ContactConfig&) const = default;
};

/// The method by which a run solves the equations of the joints.
struct JointConfig {
  Stabilization stabilization = Stabilization::none;
  std::optional<double> alpha, beta;     ///< coefficients of Baumgarte's equation, 1/s; absent: 10
  std::optional<double> alpha_per_step;  ///< a, α = β = a/h in place of them; fixed-step methods only
  std::optional<double> penalty;         ///< penalty in multiples of the mean mass; absent: 1e7
  ProjectionMetric metric = ProjectionMetric::mass;
  bool operator==(const JointConfig&) const = default;
};

/// The configuration of one run. run_options.hpp names, reads and prints each member.
struct RunConfig {
  std::string scenario;  ///< name
  /// The varied keys of the scenario with this run's values, in the order of the axes. An empty value leaves the key
  /// unchanged.
  std::vector<Override> varied;
  std::string integrator;
  Formulation formulation;
  bool normalize = false;  ///< --normalize step
  Precision precision = Precision::double_precision;
  std::optional<Summation> summation;            ///< summation; absent: plain, and not given by the study
  std::optional<ContactConfig> contact;          ///< contact; absent: the scenario has none
  std::optional<JointConfig> joints;             ///< joints; absent: the scenario has none
  std::optional<double> dt;                      ///< step of fixed-step methods, s
  std::optional<double> tolerance;               ///< tolerance of adaptive methods
  std::optional<std::int64_t> max_steps;         ///< limit for adaptive methods; absent: that of Schedule
  double t_end = 1;                              ///< end time, s
  std::optional<std::int64_t> samples;           ///< number of samples; absent: every step is observed
  bool reference = false;                        ///< --reference: a reference motion replaces unknown exact solutions
  SettingValues settings{};                      ///< chosen values of the method's own settings (Declaration::settings)
  std::map<std::string, OptionValue> further{};  ///< values of the options without a member here, by option name
};

/// A point of the thinned history of a run: the largest values within an interval of the run. A history has at most 256
/// points, however long the run.
struct SeriesPoint {
  double t = 0;                           ///< time of the largest energy drift in the interval, s
  double energy_drift_rel = 0;            ///< signed drift of largest magnitude
  double linear_momentum_drift_rel = 0;   ///< 0 if the forces do not conserve linear momentum
  double angular_momentum_drift_rel = 0;  ///< 0 if the forces do not conserve angular momentum
  double orientation_defect = 0;
};

/// The attitude error at one of at most 64 instants spread over the run.
struct AttitudeError {
  double t = 0;  ///< s
  double error_rad = 0;
};

inline bool is_compensated(const RunConfig& config) { return config.summation == Summation::compensated; }

/// Contact measures of a run (contact_meter.hpp). All absent for a run without contact.
struct ContactMeasures {
  std::optional<double> first_impact;  ///< time of the first impact that events.csv lists, s
  /// Energy lost to impacts, lost to friction, and injected by undoing penetration, each until the end of the run, J.
  std::optional<double> impact_loss, friction_loss, penetration_energy;
  /// Largest rise of E above an earlier value, and largest |E − E(0)|, J, with E = kinetic + potential energy − work of
  /// non-conservative forces. The exact values are 0 for an elastic motion without friction.
  std::optional<double> energy_rise_max, energy_change_max;
  std::optional<double> penetration_max, penetration_end;  ///< largest depth of any two bodies, and that at the end, m
  std::optional<double> displacement_max;                  ///< largest displacement of a mass centre since t = 2 s, m
  /// First time at which a mass centre was more than a tenth of its body's radius away from its initial position, s.
  std::optional<double> left_place;
};

/// Measures of the joints of a run (joint_meter.hpp), the largest over all joints and instants. All absent for a run
/// without joints.
struct JointMeasures {
  std::optional<double> gap_max;       ///< |g| of the lengths, m
  std::optional<double> angle_max;     ///< |g| of the angles, rad
  std::optional<double> velocity_max;  ///< |G v| of the lengths, m/s
  std::optional<double> rate_max;      ///< |G v| of the angles, rad/s
  // The same within steps, by the dense output of the method; absent: it has none, or there was contact.
  std::optional<double> gap_within;       ///< m
  std::optional<double> angle_within;     ///< rad
  std::optional<double> velocity_within;  ///< m/s
  std::optional<double> rate_within;      ///< rad/s
  std::optional<double> work;             ///< work of the joints until the end of the run, J; 0 for exact reactions
  std::optional<double> projection;       ///< energy injected by projections until the end of the run, J
  std::optional<double> rank;             ///< least rank of the constraint equations
  std::optional<double> iterations;       ///< iterations of the method; absent: it makes none
  std::optional<double> solves;           ///< linear systems of the joints solved by the method and by projections
  std::optional<double> condition_max;  ///< largest condition of the independent equations, in the metric of the masses
  // Against the exact motion or a reference.
  std::optional<double> speed_error_max;            ///< largest error of the velocity of a mass centre, m/s
  std::optional<double> reaction_error_max;         ///< largest error of the force of a joint, N
  std::optional<double> reaction_torque_error_max;  ///< largest error of the torque of a joint about its anchor, N m
};

struct RunResult {
  std::string status;    ///< "ok", "diverged", "failed", "refused"
  std::string message;   ///< reason, if the status is not "ok"
  double t_reached = 0;  ///< time of the last state, s
  std::int64_t steps = 0;
  std::int64_t evaluations = 0;
  std::optional<double> energy_initial;          ///< total energy E0 at the start, J
  std::optional<double> energy_scale;            ///< scale of the drift (motion_scales.hpp), J; absent if nothing moves
  std::optional<double> energy_drift_max;        ///< max |E − E0|, E from the ledger (drift_meter.hpp), J
  std::optional<double> energy_round_off;        ///< largest drift that rounding alone can explain, J
  std::optional<double> energy_drift_max_rel;    ///< energy_drift_max over energy_scale
  std::optional<double> energy_drift_final_rel;  ///< final drift over energy_scale, signed
  std::optional<double> energy_drift_rate;       ///< least-squares slope of the drift, W
  std::optional<double> energy_drift_rate_ci;    ///< half the 95 % confidence interval of that slope, W
  std::string drift_class;                       ///< a class of drift_class.hpp; empty if the status is not "ok"
  /// Exponent p of |drift| ~ t^p and its 95 % confidence interval; absent if the class has no exponent.
  std::optional<double> drift_exponent;
  std::optional<double> drift_exponent_low, drift_exponent_high;
  /// Estimated duration of a run that would decide the class, s; only for the class "undecided".
  std::optional<double> drift_decided_after;
  std::optional<double> linear_momentum_drift_max_rel;    ///< drift; absent if the forces do not conserve it
  std::optional<double> angular_momentum_drift_max_rel;   ///< drift; absent if the forces do not conserve it
  std::map<std::string, double> invariant_drift_max_rel;  ///< drifts of the declared invariants, by name
  std::optional<double> orientation_defect_max;           ///< | |q| − 1 | or the Frobenius norm of RᵀR − 1
  /// Errors against the exact motion. Absent without an exact solution or a proven reference, and for a run that
  /// broke off.
  std::optional<double> position_error_max;              ///< m
  std::optional<double> attitude_error_max;              ///< rad
  std::optional<double> angular_velocity_error_max_rel;  ///< error over the largest |ω| at the start
  /// Errors of the body-frame angular momentum of a single free body, along its polhode and off it
  /// (polhode_error.hpp).
  std::optional<double> polhode_phase_error_max;      ///< s
  std::optional<double> polhode_phase_error_max_rad;  ///< |ω(0)| polhode_phase_error_max, rad
  std::optional<double> polhode_off_error_max_rel;
  /// Uncertainties of the reference that replaced an unknown exact solution; absent if none was used. An error less
  /// than a hundred times as large is left out.
  std::optional<double> position_reference;  ///< m
  std::optional<double> attitude_reference;  ///< rad
  std::optional<double> angular_velocity_reference_rel;
  ContactMeasures contact;
  JointMeasures joints;
  /// Numbers of metrics without a member here, by name of their column (metric_table.hpp).
  std::map<std::string, double> further;
  double seconds = 0;  ///< wall time of the simulation including measurements, s; written to timings.csv only
  std::vector<SeriesPoint> series;
  std::vector<AttitudeError> attitude_errors;  ///< attitude errors; empty without an exact solution of the attitude
};

/// Removes the curves against time and frees their memory.
inline void drop_curves(RunResult& result) {
  result.series = std::vector<SeriesPoint>();
  result.attitude_errors = std::vector<AttitudeError>();
}

struct RunRecord {
  std::string id;  ///< 16 hexadecimal digits: hash of the resolved scenario, the options and the results version
  RunConfig config;
  RunResult result;
  std::shared_ptr<const Scenario> scenario{};  ///< scenario with the varied keys set; the runs of a StudyView have it
};

}  // namespace polhode::study::record
