// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/session/session_memory.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/study/metrics/motion_scales.hpp"
#include "experiments/viewer/session/reactions.hpp"

namespace polhode::viewer::inline session {
namespace {

constexpr std::size_t most_plotted = 2048;  // largest number of points of a plot or a trace
constexpr std::size_t fewest_states = 16, most_states = 1 << 16;

std::size_t states_in(std::size_t bytes, const Problem& problem) {
  constexpr std::size_t numbers_of_body = 18;  // length of a body's state in the longest formulation
  constexpr std::size_t numbers_of_joint = 6;  // most equations of a joint
  const std::size_t each =
      sizeof(Kept) + sizeof(double) * (numbers_of_body * problem.moving() + numbers_of_joint * problem.joints.size());
  return std::clamp(bytes / each, fewest_states, most_states);
}

}  // namespace

SessionMemory::SessionMemory(const study::Scenario& scenario, std::size_t bytes)
    : scenario_(scenario), capacity_(states_in(bytes, scenario.problem)), history_(capacity_), plot_(most_plotted) {}

const System<double>& SessionMemory::system(const Formulation& f) {
  const JointTreatment& j = f.joints;
  auto& made = systems_[{f.orientation, f.angular_state, f.gyroscopic, f.rotation_from, j.stabilization, j.alpha,
                         j.beta, j.penalty, j.metric}];
  if (!made) made = make_system<double>(scenario_.problem, f);
  return *made;
}

void SessionMemory::begin(const Kept& start) {
  energy_start_ = start.sample.ledger(start.losses.total());
  momentum_start_ = start.sample.seen.angular_momentum;
  history_ = Thinned<Kept>(capacity_);
  plot_ = Thinned<PlotPoint>(most_plotted);
  for (Traced& t : traced_) t.points = Thinned<TracePoint>(most_plotted);
  add(start);
}

void SessionMemory::add(const Kept& now) {
  if (plot_.wants(now.step)) plot_.add(now.step, plot_point(now));
  for (Traced& t : traced_) {
    if (t.points.wants(now.step)) t.points.add(now.step, trace_point(now, t.body));
  }
  if (history_.wants(now.step)) history_.add(now.step, now);
}

void SessionMemory::forget_after(std::int64_t step) {
  history_.forget_after(step);
  plot_.forget_after(step);
  for (Traced& t : traced_) t.points.forget_after(step);
}

bool SessionMemory::hopeless(double energy) {
  if (!std::isfinite(energy)) return true;
  // With contact the computation of a scale can take a second, during which the motion would stop. The scale of a part
  // of the motion does not exceed that of the whole; half of it allows for other steps.
  constexpr double part = 0.01;
  if (!early_scale_) early_scale_ = study::motion_scales(scenario_, part * scenario_.t_end).energy / 2;
  if (std::abs(energy) <= study::hopeless_drift * *early_scale_) return false;
  if (!energy_scale_) energy_scale_ = study::motion_scales(scenario_, scenario_.t_end).energy;
  return *energy_scale_ > 0 && std::abs(energy) > study::hopeless_drift * *energy_scale_;
}

double SessionMemory::first_time() const {
  return history_.items().empty() ? 0 : history_.items().front().value.state.t;
}

const Kept& SessionMemory::nearest(double t, const Kept& now) const {
  const Kept* best = &now;
  for (auto item = history_.items().rbegin(); item != history_.items().rend(); ++item) {
    if (std::abs(item->value.state.t - t) < std::abs(best->state.t - t)) best = &item->value;
  }
  return *best;
}

Frame SessionMemory::frame(const Kept& kept) {
  const System<double>& looked_at = system(kept.formulation);
  Frame frame;
  frame.t = kept.state.t;
  frame.step = kept.step;
  frame.bodies.reserve(looked_at.moving());
  for (std::size_t i = 0; i < looked_at.moving(); ++i) {
    frame.bodies.push_back(looked_at.snapshot(kept.state.y, i));
  }
  const PlotPoint point = plot_point(kept);
  frame.kinetic = point.kinetic;
  frame.potential = point.potential;
  frame.energy_drift = point.energy_drift;
  frame.momentum_drift = point.momentum_drift;
  frame.defect = point.defect;
  return frame;
}

std::vector<FrameReaction> SessionMemory::reactions(const Kept& kept) {
  return reactions_of(system(kept.formulation), kept.state, kept.multipliers);
}

PlotPoint SessionMemory::plot_point(const Kept& kept) const {
  const Measurement<double>& m = kept.sample.seen;
  return {kept.state.t,
          m.kinetic,
          m.potential,
          energy_drift(kept.sample, kept.losses),
          (m.angular_momentum - momentum_start_).norm(),
          m.orientation_defect};
}

TracePoint SessionMemory::trace_point(const Kept& kept, std::size_t body) {
  const BodySnapshot<double> b = system(kept.formulation).snapshot(kept.state.y, body);
  return {kept.state.t, b.position, b.rotation.transpose() * b.angular_velocity};
}

void SessionMemory::trace(std::span<const std::size_t> bodies) {
  std::vector<Traced> traced;
  for (const std::size_t body : bodies) {
    if (body >= scenario_.problem.moving()) continue;
    const auto same = [&](const Traced& t) { return t.body == body; };
    const auto old = std::find_if(traced_.begin(), traced_.end(), same);
    if (old != traced_.end()) {
      traced.push_back(std::move(*old));
      traced_.erase(old);
    } else if (std::none_of(traced.begin(), traced.end(), same)) {
      traced.push_back({body, Thinned<TracePoint>(most_plotted)});
      for (const auto& item : history_.items()) traced.back().points.add(item.step, trace_point(item.value, body));
    }
  }
  traced_ = std::move(traced);
}

std::vector<PlotPoint> SessionMemory::plot() const {
  std::vector<PlotPoint> points;
  points.reserve(plot_.items().size());
  for (const auto& item : plot_.items()) points.push_back(item.value);
  return points;
}

std::vector<Trace> SessionMemory::traces() const {
  std::vector<Trace> all;
  for (const Traced& t : traced_) {
    all.push_back({t.body, {}});
    all.back().points.reserve(t.points.items().size());
    for (const auto& item : t.points.items()) all.back().points.push_back(item.value);
  }
  return all;
}

}  // namespace polhode::viewer::session
