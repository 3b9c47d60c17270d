// SPDX-License-Identifier: BSD-3-Clause
// A session: one scenario that moves by one method at a time, in a thread of its own, or a recorded trajectory that
// plays. The window's thread gives commands, passes the time on, and looks at what is to be seen; none of that waits
// for the simulation, nor makes it wait.
//
// Time comes from the owner alone, who may have several sessions side by side:
//   const double dt = clock.tick();
//   for (auto& s : sessions) s->tick(dt);   // or tick_together(sessions, dt), so that none runs ahead of the others
// Digits do not depend on it where the accumulator drives: the session goes through the loop of core/simulate, and only
// waits between its steps. What did decide them is recorded (session_record.hpp).
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
#include "experiments/study/record/run_record.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/viewer/frame/frame.hpp"

namespace polhode::viewer::inline session {

/// What gives the steps their size.
enum class Drive {
  accumulator,  ///< dt, or the method's tolerance: as many steps as fit into the time that has passed
  /// The time between two frames, one step each, Δt = t_current − t_previous, as the engine slides have it. A step that
  /// takes longer than a frame makes the next one so much larger.
  frame_clock
};
constexpr std::string_view name(Drive d) { return d == Drive::accumulator ? "accumulator" : "frame_clock"; }

/// By what a scenario moves. Of the run: precision is double, every step is seen; dt is also the frame clock's single
/// step.
struct Configuration {
  study::RunConfig run;
  Drive drive = Drive::accumulator;
};

/// Of the scenario with what `./run simulate` takes where nothing is said: rk4 with dt = 1e-3 s, contact where it has
/// some.
Configuration usual_configuration(const study::Scenario& scenario);
/// Another method: with dt (s) or the tolerance, whichever is its own.
void choose_integrator(Configuration& configuration, const std::string& name, double dt = 1e-3,
                       double tolerance = 1e-8);
/// Why this cannot be run, in one line; empty if it can.
std::string refusal(const Configuration& configuration, const study::Scenario& scenario);

struct SessionSetup {
  std::string scenario;  ///< a built-in name or a path, as --scenario takes it
  std::vector<study::Override> overrides;
  std::optional<Configuration> configuration;  ///< absent: the usual one
  std::filesystem::path record;                ///< where to write session.toml; empty: nowhere
  /// Where to write the trajectory: segment_1/trajectory.csv and so on, one folder for each stretch of one
  /// configuration; empty: nowhere.
  std::filesystem::path trajectory;
  std::size_t history_bytes = 64 << 20;  ///< of the states that are kept for scrubbing back
};

/// What of a session is looked at beyond the bodies.
struct Wanted {
  bool contacts = false, cells = false;
  std::vector<std::size_t> traced;  ///< moving bodies whose traces are wanted
  bool operator==(const Wanted&) const = default;
};

/// A point of a plot.
struct PlotPoint {
  double t = 0;                       ///< s
  double kinetic = 0, potential = 0;  ///< J
  double energy_drift = 0;            ///< J
  double momentum_drift = 0;          ///< kg m²/s
  double defect = 0;
};

/// Where a body was, and its polhode.
struct TracePoint {
  double t = 0;                                          ///< s
  Vector3<double> position = Vector3<double>::Zero();    ///< m, of the mass centre
  Vector3<double> omega_body = Vector3<double>::Zero();  ///< rad/s, body axes
};
struct Trace {
  std::size_t body = 0;
  std::vector<TracePoint> points;  ///< in order of time, thinned
};

struct SessionStatus {
  bool playing = false;
  bool at_end = false;  ///< nothing goes on from here: t_end is reached, or the method has failed
  bool failed = false;  ///< the method gave up, or the motion diverged; the message says how
  bool paused_at_collision = false;
  bool in_the_past = false;         ///< scrubbed back; to go on from here forgets what came after
  std::string message;              ///< what there is to say: why it stopped, or why nothing is recorded any more
  double speed = 1;                 ///< simulated seconds wanted for one of the wall
  double pace = 0;                  ///< and had, over the last second
  bool slower_than_wanted = false;  ///< the simulation does not keep up, and time was let go
  double t_first = 0, t_last = 0;   ///< s: how far scrubbing reaches
  double t_end = 0;                 ///< s
  std::int64_t segment = 0;         ///< from 1: how many configurations and scrubs there were
};

/// All that the window shows, of one instant; never changed once it is handed out.
struct View {
  Frame frame;
  std::vector<PlotPoint> plot;  ///< of all there is to scrub through, thinned to 2048 points
  std::vector<Trace> traces;    ///< of the wanted bodies, thinned alike
  SessionStatus status;
  Configuration configuration;  ///< the present one
};

/// Commands are applied between two steps, in the order in which they came; all may be called from the window's thread.
class Session {
 public:
  Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  virtual ~Session() = default;  ///< ends the thread at the next step

  virtual const study::Scenario& scenario() const = 0;

  /// The latest there is; never null, never waits.
  virtual std::shared_ptr<const View> view() = 0;
  /// So many seconds of wall time have passed: once a frame. What is held back of them does not count.
  virtual void tick(double seconds, double held_back = 0) = 0;
  /// s of wall time that have passed and are still to be simulated.
  virtual double behind() const = 0;

  virtual void play() = 0;
  virtual void pause() = 0;
  virtual void step(std::int64_t count = 1) = 0;  ///< so many steps, then pauses
  virtual void reset() = 0;                       ///< to the start, with the present configuration; pauses
  virtual void set_speed(double speed) = 0;       ///< positive and finite, else std::invalid_argument
  virtual void scrub(double t) = 0;               ///< to the kept state nearest to t; pauses
  virtual void pause_on_collision(bool on) = 0;
  virtual void want(const Wanted& wanted) = 0;
  /// From the present state on. Returns why not, and then changes nothing; empty: it will be.
  virtual std::string change(const Configuration& configuration) = 0;

  /// Waits until all commands are applied and the simulation waits too: it is paused, at its end, or has caught up. For
  /// films and tests; a window never calls it.
  virtual void settle() = 0;

  /// Ends the simulation and waits for it. Returns what of the session could not be written, in one line; empty:
  /// nothing.
  virtual std::string finish() { return {}; }
};

/// Time passes for all of them alike: while one is behind by more than a quarter of a second, the others wait for it.
void tick_together(std::span<const std::unique_ptr<Session>> sessions, double seconds);

/// Starts paused at the scenario's start. Throws InputError with the reason where it cannot.
std::unique_ptr<Session> live_session(const SessionSetup& setup);

/// How a recorded trajectory is shown between its samples.
enum class Between { nearest, interpolated };

/// Plays a trajectory.csv of a study, or of any program, of this scenario. Throws InputError.
std::unique_ptr<Session> recorded_session(const std::string& trajectory, const std::string& scenario,
                                          const std::vector<study::Override>& overrides = {},
                                          Between between = Between::interpolated);

/// A recorded session carried out again, without window and pace.
struct Rerun {
  State<double> end;
  std::int64_t segments = 0, steps = 0;
  std::string digest;    ///< of the state at the end: 16 hexadecimal digits
  std::string mismatch;  ///< where it differs from what was recorded, in one line; empty: the same bytes
};
/// Throws InputError, with file, line and key, where the record cannot be read.
Rerun rerun(const std::string& session_file);

}  // namespace polhode::viewer
