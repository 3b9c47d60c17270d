// SPDX-License-Identifier: BSD-3-Clause
// A session: a scenario that is simulated in a separate thread, by one method at a time, or a recorded trajectory that
// is played. The window's thread sends commands, passes on elapsed time, and reads the latest view. None of these calls
// waits for the simulation or blocks it.
//
// Time advances only by calls of the owner, who may have several sessions side by side:
//   const double dt = clock.tick();
//   for (auto& s : sessions) s->tick(dt);   // or tick_together(sessions, dt), which keeps them at the same time
// With the drive `accumulator`, the results do not depend on wall time: the session runs simulate() and only waits
// between its steps. Everything on which the results depend is recorded (session_record.hpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/system/state.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/viewer/frame/frame.hpp"

namespace polhode::viewer::inline session {

/// Source of the step size.
enum class Drive {
  accumulator,  ///< dt, or the method's tolerance; as many steps as fit into the elapsed time
  /// The time between two frames, Δt = t_current − t_previous, one step for each frame, as in the engine slides. If the
  /// computation of a step takes longer than a frame, the next step is correspondingly larger.
  frame_clock
};
constexpr std::string_view name(Drive d) { return d == Drive::accumulator ? "accumulator" : "frame_clock"; }

/// Method and formulation of a simulation. Requirements for the run: precision double, and observation after every
/// step. With the drive `frame_clock`, dt is the size of a single step.
struct Configuration {
  study::RunConfig run;
  Drive drive = Drive::accumulator;
};

/// The default configuration of a scenario, with the defaults of `./run simulate`: rk4 with dt = 1e-3 s, and contact if
/// the scenario has contact.
Configuration usual_configuration(const study::Scenario& scenario);
/// Sets the method, with the step dt (s) of a fixed-step method or the tolerance of an adaptive one.
void choose_integrator(Configuration& configuration, const std::string& name, double dt = 1e-3,
                       double tolerance = 1e-8);
/// The run options that a session has, in the order of the table: all but those with one value in every session.
std::vector<const study::RunOption*> session_options();
/// The options of a session that choose_option() sets: all but the method and its step or tolerance.
std::vector<const study::RunOption*> chosen_options();
/// Sets one of these options to the value in the text, or to its default if the text is empty. Options that no longer
/// apply are left out; options that now apply get their defaults. Throws InputError, with the name of the option, if
/// the text is no value of it; the configuration is then unchanged.
void choose_option(Configuration& configuration, const study::RunOption& option, const std::string& text,
                   const study::Scenario& scenario);
/// The value of an option in a run as text; without a value, the equivalent one that the table or the method declares,
/// if any.
std::string value_text(const study::RunOption& option, const study::RunConfig& run);
/// The value of a yes-or-no option that means yes; empty for all other options.
std::string yes_of(const study::RunOption& option);
/// Reason, in one line, for which the configuration cannot be run; empty if it can.
std::string refusal(const Configuration& configuration, const study::Scenario& scenario);

struct SessionSetup {
  std::string scenario;  ///< built-in name or path, as for --scenario
  std::vector<study::Override> overrides;
  std::optional<Configuration> configuration;  ///< configuration; absent: usual_configuration()
  std::filesystem::path record;                ///< path of session.toml to write; empty: none is written
  /// Folder of the trajectories to write, segment_1/trajectory.csv and so on, one for each segment; empty: none are
  /// written.
  std::filesystem::path trajectory;
  std::size_t history_bytes = 64 << 20;  ///< memory of the states kept for scrubbing back, bytes
};

/// Contents of a view requested in addition to the bodies.
struct Wanted {
  bool contacts = false, cells = false;
  std::vector<std::size_t> traced;  ///< indices of the moving bodies to trace
  bool reactions = false;           ///< reactions of joints
  bool operator==(const Wanted&) const = default;
};

/// A point of a plot.
struct PlotPoint {
  double t = 0;                       ///< s
  double kinetic = 0, potential = 0;  ///< J
  double energy_drift = 0;            ///< E − E(0) of the energy ledger, J
  double momentum_drift = 0;          ///< magnitude of the change of the angular momentum, kg m²/s
  double defect = 0;                  ///< orientation defect
};

/// A point of a body's path and of its polhode.
struct TracePoint {
  double t = 0;                                          ///< s
  Vector3<double> position = Vector3<double>::Zero();    ///< position of the mass centre, world frame, m
  Vector3<double> omega_body = Vector3<double>::Zero();  ///< angular velocity, body frame, rad/s
};
struct Trace {
  std::size_t body = 0;
  std::vector<TracePoint> points;  ///< points in order of time, thinned
};

struct SessionStatus {
  bool playing = false;
  bool at_end = false;  ///< the motion has ended: t_end was reached, or the run failed
  bool failed = false;  ///< the method failed or the motion diverged; the message gives the reason
  bool paused_at_collision = false;
  bool in_the_past = false;         ///< scrubbed back; continuing from here discards the later motion
  std::string message;              ///< reason for which the motion ended or recording stopped; empty: none
  double speed = 1;                 ///< requested simulated time over wall time
  double pace = 0;                  ///< actual simulated time over wall time, over the last second
  bool slower_than_wanted = false;  ///< the simulation is too slow, and time was dropped
  double t_first = 0, t_last = 0;   ///< range of scrub(), s
  double t_end = 0;                 ///< s
  std::int64_t segment = 0;         ///< number of the present segment, from 1
};

/// Contents of the window at one instant. Immutable once published.
struct View {
  Frame frame;
  std::vector<PlotPoint> plot;  ///< points over the range of scrub(), thinned to 2048
  std::vector<Trace> traces;    ///< traces of the requested bodies, each thinned to 2048 points
  SessionStatus status;
  Configuration configuration;  ///< present configuration
};

/// A session. All functions may be called from the window's thread; commands are applied between two steps, in the
/// order of the calls.
class Session {
 public:
  Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  virtual ~Session() = default;  ///< ends the thread at the next step

  virtual const study::Scenario& scenario() const = 0;

  /// The latest view; never null. Does not wait for the simulation.
  virtual std::shared_ptr<const View> view() = 0;
  /// Adds elapsed wall time, s; call once per frame. held_back: part of it that is not to be simulated, s.
  virtual void tick(double seconds, double held_back = 0) = 0;
  /// Elapsed wall time that is still to be simulated, s.
  virtual double behind() const = 0;

  virtual void play() = 0;
  virtual void pause() = 0;
  virtual void step(std::int64_t count = 1) = 0;  ///< takes `count` steps, then pauses
  virtual void reset() = 0;                       ///< returns to the start, keeps the configuration; pauses
  virtual void set_speed(double speed) = 0;       ///< throws std::invalid_argument unless positive and finite
  virtual void scrub(double t) = 0;               ///< goes to the stored state nearest to t (s); pauses
  virtual void pause_on_collision(bool on) = 0;
  virtual void want(const Wanted& wanted) = 0;
  /// Changes the configuration from the present state on. Returns the reason for which it cannot, and changes nothing
  /// then; empty if it can.
  virtual std::string change(const Configuration& configuration) = 0;

  /// Waits until all commands are applied and the simulation is paused, at its end, or has simulated all elapsed time.
  /// For films and tests, not for windows.
  virtual void settle() = 0;

  /// Ends the simulation and waits for its thread. Returns a message, in one line, about the first file that could not
  /// be written; empty if all were written.
  virtual std::string finish() { return {}; }
};

/// Adds elapsed wall time (s) to all sessions. While one is behind by more than a quarter of a second, the others wait
/// for it, so that all stay at the same time.
void tick_together(std::span<const std::unique_ptr<Session>> sessions, double seconds);

/// A session that simulates, paused at the start of the scenario. Throws InputError, with the reason, for invalid
/// input.
std::unique_ptr<Session> live_session(const SessionSetup& setup);

/// Display of a recorded trajectory between its samples.
enum class Between { nearest, interpolated };

/// A session that plays a trajectory.csv of this scenario, written by a study or by another program. Throws InputError.
std::unique_ptr<Session> recorded_session(const std::string& trajectory, const std::string& scenario,
                                          const std::vector<study::Override>& overrides = {},
                                          Between between = Between::interpolated);

/// Result of a recorded session that was simulated again, without a window and without waiting.
struct Rerun {
  State<double> end;
  std::int64_t segments = 0, steps = 0;
  std::string digest;    ///< hash of the final state: 16 hexadecimal digits
  std::string mismatch;  ///< first difference from the record, in one line; empty: the same bytes
};
/// Simulates a recorded session again. Throws InputError, with file, line and key, if the record cannot be read.
Rerun rerun(const std::string& session_file);

}  // namespace polhode::viewer::session
