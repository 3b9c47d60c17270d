// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/session/collision_pause.hpp"

#include <algorithm>

#include "experiments/study/setup/run_setup.hpp"

namespace polhode::viewer::inline session {
namespace {

/// The state at the first impact of these pairs within the last step, for display only. It is computed from the start
/// of the step by the same method, separately from the run, which is already at the end of the step.
std::optional<Kept> state_at_impact(const System<double>& system, const study::RunConfig& run,
                                    const SegmentObserver& segment, std::span<const BodyPair> met) {
  const Kept& present = segment.present();
  double t = present.state.t;
  for (const Impact& i : segment.impacts()) {
    const BodyPair pair{static_cast<std::uint32_t>(i.a), static_cast<std::uint32_t>(i.b)};
    if (std::find(met.begin(), met.end(), pair) != met.end()) t = std::min(t, i.t);
  }
  if (!(t < present.state.t) || !(t > segment.before().t)) return std::nullopt;
  const auto method = study::integrator_of<double>(run, system);
  Kept there = present;
  there.state = segment.before();
  there.multipliers = {};
  method->begin(there.state);
  const double close = 1e-15 * t;  // shortest remaining time, s; some methods cannot make a shorter step
  while (t - there.state.t > close) {
    if (!method->step(there.state, t - there.state.t).ok()) return std::nullopt;
  }
  there.state.t = t;
  there.sample.seen = system.measure(there.state.y);
  return there;
}

}  // namespace

void CollisionPause::configure(const study::Scenario& scenario, const study::RunConfig& run) {
  if (run.contact) lookout_.emplace(scenario, *run.contact);
}

std::vector<BodyPair> CollisionPause::newly_met(const System<double>& system, const SegmentObserver& segment) {
  return lookout_->newly_met(system, segment.present().state.y, segment.impacts());
}

void CollisionPause::pause(const System<double>& system, const study::RunConfig& run, const SegmentObserver& segment,
                           std::span<const BodyPair> met) {
  paused_ = true;
  impact_ = state_at_impact(system, run, segment, met);
  contacts_ = lookout_->contacts(system, impact_ ? impact_->state.y : segment.present().state.y);
  if (!contacts_.empty()) return;
  for (const Impact& i : segment.impacts()) {
    if (!impact_ || i.t <= impact_->state.t) contacts_.push_back({i.a, i.b, i.point, i.normal, 0});
  }
}

void CollisionPause::show(const Wanted& wanted, bool at_pause, const System<double>& system, const VectorX<double>& y,
                          Frame& frame) {
  if (at_pause) frame.contacts = contacts_;
  else if (wanted.contacts && lookout_) frame.contacts = lookout_->contacts(system, y);
  if (wanted.cells && lookout_) frame.cells = lookout_->cells(system, y);
}

}  // namespace polhode::viewer::session
