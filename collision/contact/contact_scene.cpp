// SPDX-License-Identifier: BSD-3-Clause
#include "collision/contact/contact_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace polhode::inline collision::inline contact {
namespace {

template <class Entry>
const Entry& known(const Entry* entry, const char* what, std::string_view name) {
  if (!entry) throw std::invalid_argument("there is no " + std::string(what) + " '" + std::string(name) + "'");
  return *entry;
}

/// The data of a pair take some 600 bytes, and up to 8 points of some 200 bytes each.
constexpr std::size_t most_near_pairs = 1'000'000;

/// The radius about the origin of a shape's axes.
double radius_of(const Collider& collider) {
  if (!collider.shape || !collider.shape->finite()) return 0;
  const Bounds b = collider.shape->bounds({});
  return b.min().cwiseAbs().cwiseMax(b.max().cwiseAbs()).norm();
}

}  // namespace

ContactScene::ContactScene(const Problem& problem, std::vector<Collider> colliders, std::string_view broad_phase,
                           std::string_view narrow_phase)
    : moving_(problem.moving()),
      colliders_(std::move(colliders)),
      broad_(known(find_broad_phase(broad_phase), "broad phase", broad_phase).make()),
      narrow_(known(find_narrow_phase(narrow_phase), "narrow phase", narrow_phase).make()) {
  if (colliders_.size() != problem.bodies.size()) {
    throw std::invalid_argument("a contact scene needs one collider for each body");
  }
  for (const Collider& c : colliders_) {
    if (!(c.restitution >= 0 && c.restitution <= 1)) throw std::invalid_argument("a restitution must be from 0 to 1");
    if (!(c.friction >= 0) || !std::isfinite(c.friction))
      throw std::invalid_argument("a friction must not be negative");
    radii_.push_back(radius_of(c));
  }
  for (std::size_t i = 0; i < colliders_.size(); ++i) {
    if (colliders_[i].shape && (i >= moving_ || problem.bodies[i].pinned)) all_free_ = false;
  }
  for (std::size_t i = 0; i < moving_; ++i) {
    if (colliders_[i].shape && !colliders_[i].shape->finite()) {
      throw std::invalid_argument("the body '" + problem.bodies[i].name +
                                  "' has a shape without end and must be static");
    }
  }
  for (const JointParameters& joint : problem.joints) {
    const auto& [one, two] = std::minmax(joint.of.bodies.front(), joint.of.bodies.back());
    if (one != two) jointed_.push_back({std::uint32_t(one), std::uint32_t(two)});
  }
  std::sort(jointed_.begin(), jointed_.end());
  bounds_.resize(colliders_.size());
}

std::span<const BodyPair> ContactScene::near_pairs(std::span<const Pose> from, std::span<const Pose> to,
                                                   std::span<const double> bulge, double margin) {
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    if (!colliders_[i].shape) {
      bounds_[i] = Bounds(Vector3<double>::Constant(std::numeric_limits<double>::infinity()).eval());
      continue;
    }
    bounds_[i] = colliders_[i].shape->bounds(from[i]);
    if (i >= moving_) continue;
    if (to.data() != from.data()) bounds_[i].extend(colliders_[i].shape->bounds(to[i]));
    const Vector3<double> more = Vector3<double>::Constant(margin + (bulge.empty() ? 0.0 : bulge[i]));
    bounds_[i].min() -= more;
    bounds_[i].max() += more;
  }
  broad_->update(bounds_);
  pairs_.clear();
  std::swap(near_, before_);
  near_.clear();
  auto old = before_.begin();
  for (const BodyPair& p : broad_->pairs()) {
    if (p.a >= moving_ || !colliders_[p.a].shape || !colliders_[p.b].shape) continue;
    if (std::binary_search(jointed_.begin(), jointed_.end(), p)) continue;
    if (pairs_.size() == most_near_pairs) {
      std::string why = "more than ";
      why += std::to_string(most_near_pairs) + " pairs of " + std::to_string(colliders_.size());
      why += " bodies are near each other: too many bodies are in one place; set them apart, or take fewer";
      throw std::length_error(why);
    }
    pairs_.push_back(p);
    for (; old != before_.end() && old->pair < p; ++old) free_memories_.push_back(old->memory);
    if (old != before_.end() && old->pair == p) {
      near_.push_back(*old++);
    } else {
      near_.push_back({p, new_memory()});
    }
  }
  for (; old != before_.end(); ++old) free_memories_.push_back(old->memory);
  return pairs_;
}

std::uint32_t ContactScene::new_memory() {
  if (free_memories_.empty()) {
    memories_.emplace_back();
    return std::uint32_t(memories_.size() - 1);
  }
  const std::uint32_t k = free_memories_.back();
  free_memories_.pop_back();
  memories_[k] = {};
  return k;
}

std::span<ImpulseContact> ContactScene::contacts(std::span<const Pose> poses, double margin,
                                                 std::span<const double> reach) {
  contacts_.clear();
  const double least = margin;
  for (const NearPair& n : near_) {
    const auto [a, b] = n.pair;
    if (!reach.empty()) margin = least + reach[a] + reach[b];
    const Collider &of_a = colliders_[a], &of_b = colliders_[b];
    const Manifold m = narrow_->manifold(*of_a.shape, poses[a], *of_b.shape, poses[b], margin, &memories_[n.memory]);
    for (std::size_t k = 0; k < m.count; ++k) {
      if (!(m.points[k].depth >= -margin)) continue;
      ImpulseContact c;
      c.a = a;
      c.b = b;
      c.normal = m.normal;
      c.point = m.points[k].point;
      c.depth = m.points[k].depth;
      c.feature = m.points[k].feature;
      c.restitution = std::max(of_a.restitution, of_b.restitution);
      c.friction = std::sqrt(of_a.friction * of_b.friction);
      contacts_.push_back(c);
    }
  }
  return contacts_;
}

Distance ContactScene::distance(std::size_t k, std::span<const Pose> poses) {
  const auto [a, b] = near_[k].pair;
  return narrow_->distance(*colliders_[a].shape, poses[a], *colliders_[b].shape, poses[b], &memories_[near_[k].memory]);
}

void shape_poses(const System<double>& system, const VectorX<double>& y, std::vector<Pose>& poses) {
  const auto& bodies = system.problem().bodies;
  poses.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyMotion<double> m = system.motion_of(y, i);
    poses[i] = {bodies[i].pinned ? m.point(bodies[i].center_of_mass) : m.position, m.rotation};
  }
}

void impulse_bodies(const System<double>& system, const VectorX<double>& y, std::vector<ImpulseBody>& bodies) {
  const auto& all = system.problem().bodies;
  bodies.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const BodyMotion<double> m = system.motion_of(y, i);
    ImpulseBody& b = bodies[i] = {};
    b.position = m.position;
    if (all[i].fixed) continue;
    b.velocity = m.velocity;
    b.angular_velocity = m.angular_velocity;
    if (!all[i].pinned) b.inverse_mass = 1 / all[i].mass;
    b.inverse_inertia = m.rotation * system.inverse_inertia(i) * m.rotation.transpose();
  }
}

void impulse_motions(const System<double>& system, const VectorX<double>& y, std::vector<ImpulseBody>& bodies) {
  for (std::size_t i = 0; i < system.moving(); ++i) {
    const BodyMotion<double> m = system.motion_of(y, i);
    bodies[i].position = m.position;
    bodies[i].velocity = m.velocity;
    bodies[i].angular_velocity = m.angular_velocity;
  }
}

}  // namespace polhode::collision::contact
