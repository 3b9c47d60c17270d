// SPDX-License-Identifier: BSD-3-Clause
// Stored history of a session's motion, thinned to a bounded size: states for scrubbing back, the energy ledger, the
// points of plots, and the traces of bodies.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/run/contact_model.hpp"
#include "experiments/viewer/session/session.hpp"
#include "experiments/viewer/session/session_record.hpp"
#include "experiments/viewer/session/thinned.hpp"

namespace polhode::viewer::inline session {

/// A state with its place in the session and its energy ledger.
struct Kept {
  State<double> state;
  Formulation formulation;  ///< formulation of the state
  SegmentStart place;       ///< place in the session's record
  std::int64_t step = 0;    ///< number of steps since the start of the session
  Sample sample;            ///< its projection, like the losses below, is summed since the start of the session
  ContactLosses losses;
  /// Multipliers (N or N m) of the joints from a method that solves for them itself; of other methods empty.
  VectorX<double> multipliers;
};

class SessionMemory {
 public:
  SessionMemory(const study::Scenario& scenario, std::size_t bytes);

  /// The system of the scenario without contact, for measurements of states in that formulation.
  const System<double>& system(const Formulation& formulation);

  /// Starts a new history; drifts are relative to the energy and the angular momentum of this state.
  void begin(const Kept& start);
  void add(const Kept& now);
  void forget_after(std::int64_t step);

  /// Energy drift E − E(0), E from the energy ledger, J.
  double energy_drift(const Sample& sample, const ContactLosses& losses) const {
    return sample.ledger(losses.total()) - energy_start_;
  }
  /// True if an energy drift or a kinetic energy (J) is so large that the run is stopped as diverged; the limit is that
  /// of studies.
  bool hopeless(double energy);

  double first_time() const;  ///< time of the first stored state, s
  /// The state nearest to time t (s) among the stored states and `now`; the later one of two at the same distance.
  const Kept& nearest(double t, const Kept& now) const;

  Frame frame(const Kept& kept);
  std::vector<FrameReaction> reactions(const Kept& kept);

  void trace(std::span<const std::size_t> bodies);
  std::vector<PlotPoint> plot() const;
  std::vector<Trace> traces() const;

 private:
  PlotPoint plot_point(const Kept& kept) const;
  TracePoint trace_point(const Kept& kept, std::size_t body);

  const study::Scenario& scenario_;
  /// By formulation: its members, and those of its treatment of joints.
  std::map<std::tuple<Orientation, AngularState, bool, RotationFrom, Stabilization, double, double, double,
                      ProjectionMetric>,
           std::unique_ptr<System<double>>>
      systems_;
  std::size_t capacity_;
  Thinned<Kept> history_;
  Thinned<PlotPoint> plot_;
  struct Traced {
    std::size_t body;
    Thinned<TracePoint> points;
  };
  std::vector<Traced> traced_;
  double energy_start_ = 0;  ///< energy at the start, J
  /// Energy scales of the first hundredth of the motion (half of it) and of all of it, computed on demand, J.
  std::optional<double> early_scale_, energy_scale_;
  Vector3<double> momentum_start_ = Vector3<double>::Zero();
};

}  // namespace polhode::viewer::session
