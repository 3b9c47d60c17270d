// SPDX-License-Identifier: BSD-3-Clause
// gjk where surfaces bend: spheres, capsules, cylinders and ellipsoids against each other and against boxes, at random,
// in contact and one within the other, by closed forms where there are such; and what every answer keeps.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "collision/narrow_phase.hpp"
#include "collision/shapes/box.hpp"
#include "collision/shapes/capsule.hpp"
#include "collision/shapes/cylinder.hpp"
#include "collision/shapes/ellipsoid.hpp"
#include "collision/shapes/sphere.hpp"
#include "tests/collision/narrow/placed_pairs.hpp"

namespace polhode::gjk_curved_test {
namespace {

using Vector = Vector3<double>;
constexpr double relative = 1e-7;

const NarrowPhase& gjk_phase() {
  static const auto narrow = find_narrow_phase("gjk")->make();
  return *narrow;
}

/// The distance of two shapes along n, from B to A: a motion of A by its negative along n makes them touch.
double separation(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, const Vector& n) {
  const Vector low = at_a.to_world(a.support(-(at_a.rotation.transpose() * n)));
  const Vector high = at_b.to_world(b.support(at_b.rotation.transpose() * n));
  return n.dot(low - high);
}

/// The distance is `expected` to 1e-7 of the size, the normal parts the two by as much, the witness points are that far
/// apart, and the mirrored and the warm answer are the same. In a frame of its own, so that nothing stays aligned.
void expect_distance(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, double expected, double size) {
  static std::uint64_t frames = 0;
  const Pose frame = random_pose(++frames, size);
  const auto moved = [&](const Pose& p) { return Pose{frame.to_world(p.position), frame.rotation * p.rotation}; };
  const Pose a_there = moved(at_a), b_there = moved(at_b);
  PairMemory memory;
  const Distance d = gjk_phase().distance(a, a_there, b, b_there, &memory);
  const double slack = relative * size;
  SCOPED_TRACE(std::string(a.kind()) + " and " + std::string(b.kind()));
  ASSERT_NEAR(d.distance, expected, slack);
  ASSERT_NEAR(d.normal.norm(), 1, 1e-14);
  ASSERT_NEAR(separation(a, a_there, b, b_there, d.normal), expected, slack);
  ASSERT_LE((d.on_a - d.on_b - d.distance * d.normal).norm(), 1e-4 * size);
  ASSERT_EQ(gjk_phase().distance(b, b_there, a, a_there).distance, d.distance);
  ASSERT_NEAR(gjk_phase().distance(a, a_there, b, b_there, &memory).distance, expected, slack);
  if (std::abs(expected) > slack) {
    ASSERT_EQ(gjk_phase().overlap(a, a_there, b, b_there), expected < 0);
  }
}

/// Two intervals of which the one is round: apart along both, the hypotenuse; else the larger.
double of_two(double across, double along) {
  return across > 0 && along > 0 ? std::hypot(across, along) : std::max(across, along);
}

class Curved : public testing::Test {
 protected:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vector uniform3(double low, double high) { return {uniform(low, high), uniform(low, high), uniform(low, high)}; }
  std::mt19937_64 random_{1};
};

TEST_F(Curved, CylinderAndSphere) {
  for (int k = 0; k < 200; ++k) {
    const double r = uniform(0.1, 1), l = uniform(0.1, 2), ball = std::pow(10, uniform(-3, 0));
    const Vector x = uniform3(-2, 2);
    const double expected = of_two(std::hypot(x[0], x[1]) - r, std::abs(x[2]) - l / 2) - ball;
    expect_distance(Cylinder(r, l), {}, Sphere(ball), {x}, expected, 2);
    if (HasFatalFailure()) return;
  }
}

TEST_F(Curved, ParallelCylindersAndBoxesUprightOnThem) {
  for (int k = 0; k < 200; ++k) {
    const double r = uniform(0.1, 1), l = uniform(0.1, 2), r2 = uniform(0.1, 1), l2 = uniform(0.1, 2),
                 turn = uniform(0, 6);
    const Vector x = uniform3(-2, 2), h = uniform3(0.1, 1);
    const Pose at = {x, rotation_matrix(quaternion_from_rotation_vector<double>({0, 0, turn}))};
    expect_distance(Cylinder(r, l), {}, Cylinder(r2, l2), at,
                    of_two(std::hypot(x[0], x[1]) - r - r2, std::abs(x[2]) - (l + l2) / 2), 2);
    if (HasFatalFailure()) return;
    const Vector in_box = at.to_body(Vector::Zero());
    const double across = of_two(std::abs(in_box[0]) - h[0], std::abs(in_box[1]) - h[1]) - r;
    expect_distance(Cylinder(r, l), {}, Box(h), at, of_two(across, std::abs(x[2]) - l / 2 - h[2]), 2);
    if (HasFatalFailure()) return;
  }
}

/// Distance of x from the surface of the ellipsoid, negative within: the root t of Σ (s_i x_i/(t + s_i²))² = 1 with
/// t > −min s², by bisection (Eberly, Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid, 2013).
double distance_to_ellipsoid(const Vector& s, const Vector& x) {
  using Real = long double;
  const auto at = [&](Real t) {
    Real sum = -1;
    for (int i = 0; i < 3; ++i) {
      const Real q = Real(s[i]) * x[i] / (t + Real(s[i]) * s[i]);
      sum += q * q;
    }
    return sum;
  };
  Real low = -Real(s.minCoeff()) * s.minCoeff(), high = 100;
  for (int k = 0; k < 200; ++k) (at((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
  Real square = 0;
  for (int i = 0; i < 3; ++i) {
    const Real gap = x[i] * low / (low + Real(s[i]) * s[i]);
    square += gap * gap;
  }
  return double(low > 0 ? std::sqrt(square) : -std::sqrt(square));
}

TEST_F(Curved, EllipsoidAndSphere) {
  for (int k = 0; k < 200; ++k) {
    const Vector s = uniform3(0.2, 1), x = uniform3(-1.2, 1.2);
    const double ball = std::pow(10, uniform(-3, 0));
    expect_distance(Ellipsoid(s), {}, Sphere(ball), {x}, distance_to_ellipsoid(s, x) - ball, 1);
    if (HasFatalFailure()) return;
  }
}

// An ellipsoid with equal axes is a sphere, whose core in gjk is its centre: against all the others.
TEST_F(Curved, RoundEllipsoidIsASphere) {
  for (int k = 0; k < 60; ++k) {
    const double ball = uniform(0.1, 1);
    const Vector x = uniform3(-1.5, 1.5), h = uniform3(0.1, 1);
    const Box box(h);
    const Capsule capsule(h[0], h[1]);
    const Cylinder cylinder(h[0], h[1]);
    const Sphere sphere(h[2]);
    for (const Shape* other : {static_cast<const Shape*>(&box), static_cast<const Shape*>(&capsule),
                               static_cast<const Shape*>(&cylinder), static_cast<const Shape*>(&sphere)}) {
      const double expected = gjk_phase().distance(Sphere(ball), {x}, *other, {}).distance;
      expect_distance(Ellipsoid(Vector::Constant(ball)), {x}, *other, {}, expected, 1);
      if (HasFatalFailure()) return;
    }
  }
}

TEST_F(Curved, CapsulesAsSegments) {
  for (int k = 0; k < 300; ++k) {
    const double r = uniform(0.01, 1), l = uniform(0, 2), x = uniform(0, 2), z = uniform(-3, 3),
                 angle = uniform(0.1, 3);
    // Crossing at right angles to the line between them: the segments' distance is x as long as both feet are within.
    const Pose across = {{x, 0, 0}, rotation_matrix(quaternion_from_rotation_vector<double>({angle, 0, 0}))};
    expect_distance(Capsule(r, l), {}, Capsule(0.5, 1), across, x - r - 0.5, 2);
    const double beyond = std::max(std::abs(z) - (l + 1) / 2, 0.0);
    expect_distance(Capsule(r, l), {}, Capsule(0.5, 1), {{x, 0, z}}, std::hypot(x, beyond) - r - 0.5, 2);
    if (HasFatalFailure()) return;
  }
}

// Two shapes side by side along any axis of A, kissing to the last digits: always an answer, and contact where they
// overlap.
TEST_F(Curved, NeverDropsATouchingContact) {
  const Sphere sphere(0.5);
  const Capsule capsule(0.5, 1);
  const Cylinder cylinder(0.5, 1);
  const Ellipsoid ellipsoid({0.5, 0.5, 1});
  const Box box({0.5, 0.5, 0.5});
  const std::array<const Shape*, 5> all = {&sphere, &capsule, &cylinder, &ellipsoid, &box};
  for (const Shape* a : all) {
    for (const Shape* b : all) {
      for (const double gap : {0.0, 1e-15, -1e-15, 1e-12, -1e-12, 1e-9, -1e-9, -1e-5, -0.5, -1.0}) {
        expect_distance(*a, {}, *b, {{1 + gap, 0, 0}}, gap, 1);
        if (HasFatalFailure()) return;
        if (gap >= -1e-6) continue;
        // Side by side along z, a line of the one meets a line or a face of the other in two points, two faces in four.
        const auto along_z = [](const Shape* x) {
          if (x->tag() == ShapeTag::box) return 4u;
          return x->tag() == ShapeTag::capsule || x->tag() == ShapeTag::cylinder ? 2u : 1u;
        };
        EXPECT_EQ(gjk_phase().manifold(*a, {}, *b, {{1 + gap, 0, 0}}).count, std::min(along_z(a), along_z(b)))
            << a->kind() << ", " << b->kind() << " " << gap;
      }
    }
  }
}

// No NaN, no endless search; the normal parts the two by what is said, at any size ratio, also where one is within the
// other.
TEST_F(Curved, EveryAnswerIsSound) {
  for (std::uint64_t k = 0; k < 1500; ++k) {
    const PlacedPair p = any_pair(k);
    const Distance d = gjk_phase().distance(*p.a, p.at_a, *p.b, p.at_b);
    const double size = p.size_a + p.size_b;
    ASSERT_TRUE(std::isfinite(d.distance)) << k;
    ASSERT_NEAR(d.normal.norm(), 1, 1e-14) << k;
    ASSERT_NEAR(separation(*p.a, p.at_a, *p.b, p.at_b, d.normal), d.distance, relative * size) << k;
    // No direction parts them further.
    for (int m = 0; m < 20; ++m) {
      const Vector n = uniform3(-1, 1).normalized();
      ASSERT_LE(separation(*p.a, p.at_a, *p.b, p.at_b, n), d.distance + relative * size) << k;
    }
  }
}

}  // namespace
}  // namespace polhode::gjk_curved_test
