// SPDX-License-Identifier: BSD-3-Clause
// What a session remembers of its motion, bounded and thinned: states to go back to, its energy ledger, the points of
// its plots and the traces of bodies.
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

/// A state with all that belongs to it.
struct Kept {
  State<double> state;
  Formulation formulation;  ///< of the state
  SegmentStart place;       ///< where in the session's record it is
  std::int64_t step = 0;    ///< of the session, from its start
  Sample sample;            ///< its projection counts from the session's start, and so do the losses
  ContactLosses losses;
};

class SessionMemory {
 public:
  SessionMemory(const study::Scenario& scenario, std::size_t bytes);

  /// The scenario's system without contact, to look at states of that formulation.
  const System<double>& system(const Formulation& formulation);

  /// Begins anew from here; the ledger and L(0) are from here on.
  void begin(const Kept& start);
  void add(const Kept& now);
  void forget_after(std::int64_t step);

  /// J, what the ledger cannot explain.
  double energy_drift(const Sample& sample, const ContactLosses& losses) const {
    return sample.ledger(losses.total()) - energy_start_;
  }
  /// Whether an energy drift, or a kinetic energy (J), ends the run as diverged, as it does in a study.
  bool hopeless(double energy);

  double first_time() const;  ///< s
  /// The one nearest in time, `now` among them; of two as near the later.
  const Kept& nearest(double t, const Kept& now) const;

  Frame frame(const Kept& kept);

  void trace(std::span<const std::size_t> bodies);
  std::vector<PlotPoint> plot() const;
  std::vector<Trace> traces() const;

 private:
  PlotPoint plot_point(const Kept& kept) const;
  TracePoint trace_point(const Kept& kept, std::size_t body);

  const study::Scenario& scenario_;
  std::map<std::tuple<Orientation, AngularState, bool, RotationFrom>, std::unique_ptr<System<double>>> systems_;
  std::size_t capacity_;
  Thinned<Kept> history_;
  Thinned<PlotPoint> plot_;
  struct Traced {
    std::size_t body;
    Thinned<TracePoint> points;
  };
  std::vector<Traced> traced_;
  double energy_start_ = 0;  ///< J
  /// J, of the first hundredth of the motion and of all of it, found when they are first needed.
  std::optional<double> early_scale_, energy_scale_;
  Vector3<double> momentum_start_ = Vector3<double>::Zero();
};

}  // namespace polhode::viewer
