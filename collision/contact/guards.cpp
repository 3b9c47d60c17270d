// SPDX-License-Identifier: BSD-3-Clause
#include "collision/contact/guards.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polhode {
namespace {

double largest_radius(const ContactScene& scene) {
  double largest = 0;
  for (std::size_t i = 0; i < scene.size(); ++i) largest = std::max(largest, scene.radius(i));
  return largest;
}

/// A body's furthest point along n, as a place along it.
double reach(const Shape& shape, const Pose& pose, const Vector3<double>& n) {
  return n.dot(pose.position) + n.dot(pose.rotation * shape.support(pose.rotation.transpose() * n));
}

}  // namespace

ContactLengths::ContactLengths(const ContactScene& scene) {
  const double largest = largest_radius(scene);
  touch = 1e-9 * largest;
  sink = 1e-7 * largest;
  hop = 1e-11 * largest;
  met = 0.1 * hop;
}

Guards::Guards(const System<double>& system, ContactScene& scene)
    : system_(system), scene_(scene), lengths_(scene), bulge_(scene.size(), 0), speed_(scene.size(), 0),
      acceleration_(scene.size(), 0) {}

void Guards::watch(const State<double>& from, const State<double>& to, std::span<const ImpulseContact> resting, double deeper) {
  shape_poses(system_, from.y, poses_);
  shape_poses(system_, to.y, end_poses_);
  impulse_bodies(system_, from.y, bodies_);
  impulse_bodies(system_, to.y, end_);
  const double length = to.t - from.t;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const double radius = scene_.radius(i), rate = std::max(bodies_[i].angular_velocity.norm(), end_[i].angular_velocity.norm());
    const double change = (end_[i].velocity - bodies_[i].velocity).norm();
    const double turned = (end_[i].angular_velocity - bodies_[i].angular_velocity).norm();
    speed_[i] = 1.1 * (std::max(bodies_[i].velocity.norm(), end_[i].velocity.norm()) + change + rate * radius);
    bulge_[i] = length * (change + rate * radius);
    // Twice the mean change; of turning, that to the axis, and as much again, which is what a free body's rate may change by.
    acceleration_[i] = 2 * change / length + radius * (2 * turned / length + 2 * rate * rate);
  }
  const std::span<const BodyPair> pairs = scene_.near_pairs(poses_, end_poses_, bulge_, lengths_.touch + lengths_.sink);
  guards_.assign(pairs.size(), {});
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const double distance = scene_.distance(k, poses_).distance;
    Guard& g = guards_[k];
    g.pair = pairs[k];
    g.speed = speed_[g.pair.a] + speed_[g.pair.b];
    g.acceleration = acceleration_[g.pair.a] + acceleration_[g.pair.b];
    const bool held = std::any_of(resting.begin(), resting.end(), [&](const ImpulseContact& c) {
      return c.a == g.pair.a && c.b == g.pair.b;
    });
    if (held) {
      // As deep as it is, and no deeper: sinking from one bounce to the next would feed them. A body that rolls may sink on.
      g.allowance = std::max(lengths_.sink, deeper - distance);
      g.speed = 0;
      g.leaving = g.allowance > lengths_.sink;
    } else if (distance <= lengths_.met) {
      g.leaving = true;  // it was no impact, so it comes apart
    }
  }
}

bool Guards::some_leave() const {
  return std::any_of(guards_.begin(), guards_.end(), [](const Guard& g) { return g.leaving; });
}

double Guards::least(const State<double>& state) {
  shape_poses(system_, state.y, end_poses_);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < guards_.size(); ++k) {
    least = std::min(least, scene_.distance(k, end_poses_).distance + guards_[k].allowance);
  }
  return std::isfinite(least) ? least : 1;
}

void Guards::look(const State<double>& state, Look& seen) {
  shape_poses(system_, state.y, seen.poses);
  seen.values.resize(guards_.size());
  seen.normals.resize(guards_.size());
  seen.least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < guards_.size(); ++k) {
    const Distance d = scene_.distance(k, seen.poses);
    seen.values[k] = d.distance + guards_[k].allowance;
    seen.normals[k] = d.normal;
    seen.least = std::min(seen.least, seen.values[k]);
  }
  if (!std::isfinite(seen.least)) seen.least = 1;
}

/// m: how far A is beyond B along n.
double Guards::separation(const Guard& g, const Vector3<double>& n, std::span<const Pose> poses) const {
  const Shape &a = *scene_.collider(g.pair.a).shape, &b = *scene_.collider(g.pair.b).shape;
  return -reach(a, poses[g.pair.a], -n) - reach(b, poses[g.pair.b], n);
}

bool Guards::may_dip(const Look& from, const Look& to, double length) const {
  for (std::size_t k = 0; k < guards_.size(); ++k) {
    const Guard& g = guards_[k];
    const double first = from.values[k], last = to.values[k];
    if (!(first + last <= g.speed * length)) continue;
    const double sag = g.acceleration * length * length / 8 - lengths_.met;
    if (!(std::min(first, last) > sag)) return true;
    const bool fixed = from.normals[k] == to.normals[k];  // as a half-space's is
    const auto stays = [&](const Vector3<double>& n, double here, std::span<const Pose> there) {
      if (n.isZero(0)) return false;
      return std::min(here, separation(g, n, there) + g.allowance) > sag;
    };
    if (!fixed && !stays(from.normals[k], first, to.poses) && !stays(to.normals[k], last, from.poses)) return true;
  }
  return false;
}

}  // namespace polhode
