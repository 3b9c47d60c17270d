// SPDX-License-Identifier: BSD-3-Clause
// Bodies that meet, as a response gets them, and the conserved quantities.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "collision/response.hpp"
#include "core/math/portable_random.hpp"

namespace polhode::laws {

struct ImpulseScene {
  std::vector<ImpulseBody> bodies;
  std::vector<ImpulseContact> contacts;

  Vector3<double> relative(const ImpulseContact& c) const {
    return bodies[c.a].velocity_at(c.point) - bodies[c.b].velocity_at(c.point);
  }
  /// Sets the normal velocities at which the bodies meet, and those that restitution requires.
  void meet() {
    for (ImpulseContact& c : contacts) {
      c.approach = c.normal.dot(relative(c));
      c.wanted = std::max(0.0, -c.restitution * c.approach);
    }
  }
};

inline ImpulseBody cube(double mass, double side, const Vector3<double>& position, const Matrix3<double>& rotation) {
  ImpulseBody b;
  b.position = position;
  b.inverse_mass = 1 / mass;
  b.inverse_inertia = rotation * (6 / (mass * side * side) * Matrix3<double>::Identity()) * rotation.transpose();
  return b;
}
inline ImpulseBody ball(double mass, double radius, const Vector3<double>& position) {
  ImpulseBody b;
  b.position = position;
  b.inverse_mass = 1 / mass;
  b.inverse_inertia = 2.5 / (mass * radius * radius) * Matrix3<double>::Identity();
  return b;
}

/// Kinetic energy of the moving bodies, J.
inline double kinetic_energy(std::span<const ImpulseBody> bodies) {
  double sum = 0;
  for (const ImpulseBody& b : bodies) {
    if (b.inverse_mass > 0) sum += 0.5 * b.velocity.squaredNorm() / b.inverse_mass;
    if (!b.inverse_inertia.isZero(0))
      sum += 0.5 * b.angular_velocity.dot(b.inverse_inertia.inverse() * b.angular_velocity);
  }
  return sum;
}
inline Vector3<double> linear_momentum(std::span<const ImpulseBody> bodies) {
  Vector3<double> sum = Vector3<double>::Zero();
  for (const ImpulseBody& b : bodies) sum += b.velocity / b.inverse_mass;
  return sum;
}
/// About the world's origin.
inline Vector3<double> angular_momentum(std::span<const ImpulseBody> bodies) {
  Vector3<double> sum = Vector3<double>::Zero();
  for (const ImpulseBody& b : bodies) {
    sum += b.position.cross(b.velocity) / b.inverse_mass + b.inverse_inertia.inverse() * b.angular_velocity;
  }
  return sum;
}

struct SceneKind {
  int bodies = 4;
  double statics = 0;      ///< share of the bodies that cannot move
  double friction = 0;     ///< up to this
  double restitution = 0;  ///< up to this
  double spread = 0.5;     ///< powers of ten by which masses differ
};

/// Bodies at random, each two with a chance of a patch of one to four points.
inline ImpulseScene random_scene(PortableRandom& random, const SceneKind& kind) {
  ImpulseScene s;
  for (int i = 0; i < kind.bodies; ++i) {
    ImpulseBody b;
    b.position = random.uniform_vector(-2, 2);
    if (!random.chance(kind.statics)) {
      b.inverse_mass = random.power_of_ten(-kind.spread, kind.spread);
      const Matrix3<double> r = random.rotation();
      // The squared sides of a box, each side from 1 to 2.
      const Vector3<double> h = random.uniform_vector(1, 2).array().square();
      b.inverse_inertia =
          r *
          (12 * b.inverse_mass * Vector3<double>(1 / (h[1] + h[2]), 1 / (h[2] + h[0]), 1 / (h[0] + h[1])))
              .asDiagonal() *
          r.transpose();
      b.velocity = random.uniform_vector(-2, 2);
      b.angular_velocity = random.uniform_vector(-2, 2);
    }
    s.bodies.push_back(b);
  }
  for (std::uint32_t a = 0; a < s.bodies.size(); ++a) {
    for (std::uint32_t b = a + 1; b < s.bodies.size(); ++b) {
      if (!random.chance(0.6)) continue;
      const Vector3<double> n = random.direction(), t = n.unitOrthogonal(), u = n.cross(t);
      const Vector3<double> middle =
          0.5 * (s.bodies[a].position + s.bodies[b].position) + random.uniform_vector(-0.3, 0.3);
      const double friction = random.uniform(0, kind.friction), restitution = random.uniform(0, kind.restitution);
      const int points = 1 + random.below(4);
      for (int k = 0; k < points; ++k) {
        ImpulseContact c;
        c.a = a;
        c.b = b;
        c.normal = n;
        c.point = middle + 0.4 * std::cos(2.0 * k) * t + 0.4 * std::sin(2.0 * k) * u;
        c.friction = friction;
        c.restitution = restitution;
        c.feature = {Feature::Kind::vertex_face, std::uint32_t(k), 0};
        s.contacts.push_back(c);
      }
    }
  }
  s.meet();
  return s;
}

}  // namespace polhode::laws
