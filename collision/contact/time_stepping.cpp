// SPDX-License-Identifier: BSD-3-Clause
#include "collision/contact/time_stepping.hpp"

#include <algorithm>
#include <limits>

#include "collision/contact/contact_losses.hpp"

namespace polhode::inline collision::inline contact {

TimeStepping::TimeStepping(System<double>& system, ContactScene& scene, std::unique_ptr<Response> response,
                           Reflected reflected)
    : system_(system), scene_(scene), response_(std::move(response)), joined_(system), reflected_(reflected) {
  auto forces = std::make_unique<ConstantContactForces>(scene.all_free());
  contact_forces_ = forces.get();
  system.add_force(std::move(forces));
}

void TimeStepping::begin(Integrator<double>&, const State<double>&) {
  response_->forget();
  joined_.forget();
  contact_forces_->release();
  losses_ = {};
  impacts_.clear();
}

/// The contacts where the step starts, and those that it may reach: a surface that is apart lets the bodies come as
/// close as they are in the step. Only an impact that bounces waits until the surfaces have met.
std::span<ImpulseContact> TimeStepping::find_contacts(const State<double>& start, double h) {
  shape_poses(system_, start.y, poses_);
  reach_.assign(bodies_.size(), 0);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    reach_[i] = h * (bodies_[i].velocity.norm() + bodies_[i].angular_velocity.norm() * scene_.radius(i));
  }
  scene_.near_pairs(poses_, poses_, reach_, 0);
  const std::span<ImpulseContact> all = scene_.contacts(poses_, 0, reach_);
  const auto normal_speed = [&](const std::vector<ImpulseBody>& bodies, const ImpulseContact& c) {
    return (bodies[c.a].velocity_at(c.point) - bodies[c.b].velocity_at(c.point)).dot(c.normal);
  };
  std::size_t count = 0;
  for (ImpulseContact c : all) {
    const double at_start = normal_speed(start_, c), at_end = normal_speed(bodies_, c);
    c.approach = reflected_ == Reflected::at_start ? at_start : at_end;
    // A velocity that the forces cause within one step of rest is no impact.
    const double slow = 2 * std::abs(at_end - at_start);
    if (!(c.approach < -slow)) c.restitution = 0;
    if (c.depth < 0) {
      if (c.restitution > 0 || at_end >= c.depth / h) continue;
      c.wanted = c.depth / h;
    } else {
      c.wanted = -c.restitution * std::min(c.approach, 0.0);
      if (c.wanted > 0 || at_start > slow) c.depth = 0;  // they come apart by themselves: no push out of each other
    }
    all[count++] = c;
  }
  return all.first(count);
}

StepResult TimeStepping::step(Integrator<double>& method, State<double>& state, double h) {
  impacts_.clear();
  contact_forces_->release();
  free_ = state;
  StepResult result = method.step(free_, h);
  if (!result.ok()) return result;
  if (!free_.y.allFinite()) {  // a state that is lost touches nothing
    state = free_;
    return result;
  }
  impulse_bodies(system_, state.y, start_);
  bodies_ = start_;
  impulse_motions(system_, free_.y, bodies_);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    bodies_[i].position = start_[i].position;  // the free end's velocities alone
  const std::span<ImpulseContact> contacts = find_contacts(state, h);
  if (contacts.empty()) {
    std::swap(state.y, free_.y);
    state.t = free_.t;
    return result;
  }
  joined_.resolve(*response_, state.y, bodies_, contacts, h);
  contact_forces_->hold(contacts, start_, h);
  before_ = state;
  method.discard_history(state);
  result = method.step(state, h);
  contact_forces_->release();
  if (!result.ok()) {
    state = before_;
    return result;
  }
  account(state, contacts);
  undo_penetration(state);
  method.discard_history(state);
  return result;
}

/// The work of the held forces by the trapezoidal rule, along the normals and against the slip.
void TimeStepping::account(const State<double>& end, std::span<const ImpulseContact> contacts) {
  end_ = start_;
  impulse_motions(system_, end.y, end_);
  for (const ImpulseContact& c : contacts) {
    const double lost = book(c, start_, end_, losses_);
    if (c.approach < 0 && c.restitution > 0 && !c.impulse.isZero(0)) {
      impacts_.push_back({end.t, c.a, c.b, c.point, c.normal, c.impulse, lost, {}});
    }
  }
}

void TimeStepping::undo_penetration(State<double>& state) {
  double before = 0;
  bool moved = false;
  for (std::size_t i = 0; i < system_.moving(); ++i) {
    if (bodies_[i].shift.isZero(0) && bodies_[i].turn.isZero(0)) continue;
    if (!moved) before = system_.measure(state.y).energy();
    moved = true;
    system_.displace(state.y, i, bodies_[i].shift, bodies_[i].turn);
  }
  if (moved) losses_.penetration += system_.measure(state.y).energy() - before;
}

}  // namespace polhode::collision::contact
