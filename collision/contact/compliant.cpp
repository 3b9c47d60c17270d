// SPDX-License-Identifier: BSD-3-Clause
#include "collision/contact/compliant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace polhode::inline collision::inline contact {
namespace {

constexpr double duration = 5e-3;  // duration of an elastic impact, if no stiffness is given, s

bool same_pose(const Pose& a, const Pose& b) { return a.position == b.position && a.rotation == b.rotation; }
bool is_finite(const Pose& p) { return p.position.allFinite() && p.rotation.allFinite(); }
bool is_round(ShapeTag tag) { return tag == ShapeTag::sphere || tag == ShapeTag::ellipsoid; }

}  // namespace

double damping_ratio(double restitution) {
  const double wanted = -std::log(std::max(restitution, std::exp(-2.0)));  // 2 ζ φ/sin φ with ζ = cos φ, from 0 to 2
  double low = 0, high = 0.5 * std::numbers::pi;                           // it falls with φ
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (2 * middle / std::tan(middle) > wanted ? low : high) = middle;
  }
  return restitution < 1 ? std::cos(high) : 0;
}

Compliant::Compliant(const System<double>& system, ContactScene& scene, const Compliance& compliance)
    : scene_(scene), compliance_(compliance) {
  const auto& bodies = system.problem().bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& b = bodies[i];
    Matter m{std::numeric_limits<double>::infinity(), 0, Matrix3<double>::Zero(), Vector3<double>::Zero(),
             damping_ratio(scene.collider(i).restitution)};
    if (!b.fixed) {
      m.mass = b.mass;
      m.inverse_mass = b.pinned ? 0 : 1 / b.mass;
      m.inverse_inertia = system.inverse_inertia(i);
    }
    if (b.pinned) m.center = b.center_of_mass;
    matter_.push_back(m);
  }
  poses_.resize(bodies.size());
}

std::span<const ImpulseContact> Compliant::contacts(std::span<const BodyMotion<double>> bodies) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    poses_[i] = {bodies[i].point(matter_[i].center), bodies[i].rotation};
  }
  if (std::equal(poses_.begin(), poses_.end(), seen_.begin(), seen_.end(), same_pose)) return contacts_;
  seen_ = poses_;
  contacts_ = {};  // a state that is lost touches nothing
  if (!std::all_of(poses_.begin(), poses_.end(), is_finite)) return contacts_;
  scene_.near_pairs(poses_, poses_, {}, 0);
  return contacts_ = scene_.contacts(poses_, 0);
}

double Compliant::stiffness_of(const ImpulseContact& c) const {
  if (compliance_.stiffness > 0) return compliance_.stiffness;
  const double rate = std::numbers::pi / duration;
  return rate * rate / (1 / matter_[c.a].mass + 1 / matter_[c.b].mass);
}

/// The velocity that a unit impulse along the normal gives to the body's point, 1/kg.
double Compliant::mobility_of(std::uint32_t i, const BodyMotion<double>& body, const ImpulseContact& c) const {
  const Vector3<double> turn = body.rotation.transpose() * (c.point - body.position).cross(c.normal);
  return matter_[i].inverse_mass + turn.dot(matter_[i].inverse_inertia * turn);
}

Compliant::Push Compliant::push_of(const ImpulseContact& c, std::span<const BodyMotion<double>> bodies) const {
  const BodyMotion<double>&a = bodies[c.a], &b = bodies[c.b];
  const Vector3<double> v = a.point_velocity(c.point) - b.point_velocity(c.point);
  Push p;
  const double k = stiffness_of(c), ratio = std::min(matter_[c.a].damping_ratio, matter_[c.b].damping_ratio);
  p.sinking = -v.dot(c.normal);
  p.spring = p.normal = k * c.depth;
  const double mobility = ratio > 0 ? mobility_of(c.a, a, c) + mobility_of(c.b, b, c) : 0;
  if (mobility > 0) p.normal = std::max(0.0, p.spring + 2 * ratio * std::sqrt(k / mobility) * p.sinking);
  p.slip = v + p.sinking * c.normal;
  const double s = compliance_.slip_speed;
  p.friction = -c.friction * p.normal / std::sqrt(p.slip.squaredNorm() + s * s) * p.slip;
  return p;
}

bool Compliant::has_potential(const ImpulseContact& c) const {
  const ShapeTag a = scene_.collider(c.a).shape->tag(), b = scene_.collider(c.b).shape->tag();
  if (a == ShapeTag::compound || b == ShapeTag::compound) return false;
  if (is_round(a) || is_round(b)) return true;
  const auto on_plane = [](ShapeTag tag, ShapeTag plane) {
    return plane == ShapeTag::half_space && (tag == ShapeTag::box || tag == ShapeTag::capsule);
  };
  return on_plane(a, b) || on_plane(b, a);
}

void Compliant::add_wrench(double, std::span<const BodyMotion<double>> bodies,
                           std::span<Wrench<double>> wrenches) const {
  for (const ImpulseContact& c : contacts(bodies)) {
    const Push p = push_of(c, bodies);
    const Vector3<double> f = p.normal * c.normal + p.friction;
    wrenches[c.a].add_at_point(bodies[c.a], c.point, f);
    wrenches[c.b].add_at_point(bodies[c.b], c.point, -f);
  }
}

double Compliant::potential_energy(std::span<const BodyMotion<double>> bodies) const {
  double sum = 0;
  for (const ImpulseContact& c : contacts(bodies)) {
    if (has_potential(c)) sum += 0.5 * stiffness_of(c) * c.depth * c.depth;
  }
  return sum;
}

/// The whole force's power is that of −f ḋ and of friction; the spring's is −k d ḋ.
double Compliant::power(double, std::span<const BodyMotion<double>> bodies) const {
  double sum = 0;
  for (const ImpulseContact& c : contacts(bodies)) {
    const Push p = push_of(c, bodies);
    sum += p.friction.dot(p.slip) - (p.normal - (has_potential(c) ? p.spring : 0)) * p.sinking;
  }
  return sum;
}

}  // namespace polhode::collision::contact

namespace polhode::inline collision::inline response {

ResponseEntry compliant() {
  return {"compliant",
          "f = max(0, k d + c ḋ) and smooth friction at each point: a force, so that --impact-timing means nothing",
          nullptr, [](const System<double>& system, ContactScene& scene, const Compliance& compliance) {
            return std::unique_ptr<ForceModel<double>>(new Compliant(system, scene, compliance));
          }};
}

}  // namespace polhode::collision::response
