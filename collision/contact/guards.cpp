// SPDX-License-Identifier: BSD-3-Clause
#include "collision/contact/guards.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polhode::inline collision::inline contact {
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
  contact_tolerance = 1e-9 * largest;
  allowed_penetration = 1e-7 * largest;
  minimum_bounce_height = 1e-11 * largest;
  met = 0.1 * minimum_bounce_height;
}

Guards::Guards(const System<double>& system, ContactScene& scene)
    : system_(system),
      scene_(scene),
      lengths_(scene),
      bulge_(scene.size(), 0),
      speed_(scene.size(), 0),
      pulls_(scene.size()) {}

double Guards::Pull::along(const Vector3<double>& n) const {
  const double across = std::max(turning[0].cross(n).norm(), turning[1].cross(n).norm()) + turned;
  return steady + radius * rate * across;
}

void Guards::watch(const State<double>& from, const State<double>& to, std::span<const ImpulseContact> resting,
                   double deeper) {
  shape_poses(system_, from.y, poses_);
  shape_poses(system_, to.y, end_poses_);
  impulse_bodies(system_, from.y, bodies_);
  impulse_bodies(system_, to.y, end_);
  const double length = to.t - from.t;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Pull& p = pulls_[i];
    p.turning = {bodies_[i].angular_velocity, end_[i].angular_velocity};
    p.rate = std::max(p.turning[0].norm(), p.turning[1].norm());
    p.turned = (p.turning[1] - p.turning[0]).norm();
    const Shape* shape = scene_.collider(i).shape.get();
    p.radius = shape && shape->tag() == ShapeTag::sphere ? 0 : scene_.radius(i);  // a ball is the same however it turns
    const double change = (end_[i].velocity - bodies_[i].velocity).norm();
    speed_[i] = 1.1 * (std::max(bodies_[i].velocity.norm(), end_[i].velocity.norm()) + change + p.rate * p.radius);
    bulge_[i] = length * (change + p.rate * p.radius);
    // Twice the mean change, and by how much that of a free body's turning may differ within the flight.
    p.steady = 2 * change / length + p.radius * (2 * p.turned / length + p.rate * p.rate * p.rate * length);
  }
  const std::span<const BodyPair> pairs =
      scene_.near_pairs(poses_, end_poses_, bulge_, lengths_.contact_tolerance + lengths_.allowed_penetration);
  guards_.assign(pairs.size(), {});
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const double distance = scene_.distance(k, poses_).distance;
    Guard& g = guards_[k];
    g.pair = pairs[k];
    g.speed = speed_[g.pair.a] + speed_[g.pair.b];
    const bool held = std::any_of(resting.begin(), resting.end(),
                                  [&](const ImpulseContact& c) { return c.a == g.pair.a && c.b == g.pair.b; });
    if (held) {
      // The pair may be as deep as it is, and no deeper: sinking from one bounce to the next would feed the bounces. A
      // body that rolls may sink further.
      g.allowance = std::max(lengths_.allowed_penetration, deeper - distance);
      g.speed = 0;
      g.leaving = g.allowance > lengths_.allowed_penetration;
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

void Guards::evaluate(const State<double>& state, Values& seen) {
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

/// Distance by which A is beyond B along n, m.
double Guards::separation(const Guard& g, const Vector3<double>& n, std::span<const Pose> poses) const {
  const Shape &a = *scene_.collider(g.pair.a).shape, &b = *scene_.collider(g.pair.b).shape;
  return -reach(a, poses[g.pair.a], -n) - reach(b, poses[g.pair.b], n);
}

bool Guards::may_dip(const Values& from, const Values& to, double length) const {
  for (std::size_t k = 0; k < guards_.size(); ++k) {
    const Guard& g = guards_[k];
    const double first = from.values[k], last = to.values[k];
    if (!(first + last <= g.speed * length)) continue;
    const auto stays = [&](const Vector3<double>& n, double here, double there) {
      const double sag = (pulls_[g.pair.a].along(n) + pulls_[g.pair.b].along(n)) * length * length / 8;
      return std::min(here, there) > sag - lengths_.met;
    };
    const Vector3<double>&n = from.normals[k], &m = to.normals[k];
    if (n == m) {  // the normal of a half-space is always the same
      if (!n.isZero(0) && stays(n, first, last)) continue;
    } else {
      if (!n.isZero(0) && stays(n, first, separation(g, n, to.poses) + g.allowance)) continue;
      if (!m.isZero(0) && stays(m, separation(g, m, from.poses) + g.allowance, last)) continue;
    }
    return true;
  }
  return false;
}

}  // namespace polhode::collision::contact
