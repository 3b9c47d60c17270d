// SPDX-License-Identifier: BSD-3-Clause
// Each shape's formula against the slides' sums over points that fill the shape, at Gauss–Legendre nodes, which
// integrate the polynomials that the sums become exactly.
#include "collision/shapes/shape_inertia.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "collision/shapes/shape_catalogue.hpp"
#include "core/problem/inertia.hpp"

namespace polhode::shape_inertia_test {
namespace {

using Vector = Vector3<double>;
using Sizes = std::map<std::string, ParameterValue>;

/// Nodes and weights on [−1, 1], exact for polynomials of degree 9.
constexpr std::array<std::array<double, 2>, 5> gauss = {{{-0.9061798459386640, 0.2369268850561891},
                                                         {-0.5384693101056831, 0.4786286704993665},
                                                         {0.0, 0.5688888888888889},
                                                         {0.5384693101056831, 0.4786286704993665},
                                                         {0.9061798459386640, 0.2369268850561891}}};

/// Fills ellipses of half axes a(z), b(z) for z from `low` to `high` (m) with points; their masses are volumes.
void fill(std::vector<PointMass>& points, double low, double high, const std::function<double(double)>& a,
          const std::function<double(double)>& b) {
  constexpr int angles = 8;  // exact for the second harmonics that the sums hold
  for (const auto& [s, ws] : gauss) {
    const double z = 0.5 * (low + high) + 0.5 * (high - low) * s, dz = 0.5 * (high - low) * ws;
    for (const auto& [u, wu] : gauss) {
      const double r = 0.5 * (1 + u), dr = 0.5 * wu;  // share of the ellipse's half axes
      for (int k = 0; k < angles; ++k) {
        const double angle = 2 * std::numbers::pi * k / angles;
        const double volume = dz * a(z) * b(z) * r * dr * 2 * std::numbers::pi / angles;
        points.push_back({volume, {a(z) * r * std::cos(angle), b(z) * r * std::sin(angle), z}});
      }
    }
  }
}

void expect_inertia(const char* shape, const Sizes& sizes, std::vector<PointMass> points, double volume) {
  EXPECT_NEAR(total_mass(points), volume, 1e-13 * volume) << shape;
  constexpr double mass = 2.5;
  for (PointMass& p : points) p.mass *= mass / volume;
  EXPECT_LE(mass_center(points).norm(), 1e-14) << shape;
  const Matrix3<double> by_points = inertia_of(points);
  const Matrix3<double> by_formula = find_shape(shape)->moments(mass, {sizes}).asDiagonal();
  EXPECT_LE((by_points - by_formula).norm(), 1e-13 * by_formula.norm()) << shape << '\n'
                                                                        << by_points << "\nis not\n"
                                                                        << by_formula;
}

TEST(ShapeInertia, Box) {
  const Vector size(0.1, 0.4, 0.9);
  std::vector<PointMass> points;
  for (const auto& [x, wx] : gauss) {
    for (const auto& [y, wy] : gauss) {
      for (const auto& [z, wz] : gauss) {
        points.push_back({wx * wy * wz * size.prod() / 8, 0.5 * Vector(x, y, z).cwiseProduct(size)});
      }
    }
  }
  expect_inertia("box", {{"size", size}}, points, size.prod());
}

TEST(ShapeInertia, BoxOfPetersAndHsu) {
  const Vector moments = find_shape("box")->moments(10, {{{"size", Vector(0.1, 0.4, 0.9)}}});
  EXPECT_LE((moments - Vector(0.80833333, 0.68333333, 0.14166667)).cwiseAbs().maxCoeff(), 5e-9);
}

TEST(ShapeInertia, CubeOfTheCourseReport) {
  const Vector moments = find_shape("box")->moments(3, {{{"size", Vector(2, 2, 2)}}});
  EXPECT_LE((moments - Vector::Constant(3 * 4 / 6.0)).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(ShapeInertia, Sphere) {
  constexpr double r = 0.3;
  std::vector<PointMass> points;
  const auto width = [&](double z) { return std::sqrt(r * r - z * z); };
  fill(points, -r, r, width, width);
  expect_inertia("sphere", {{"radius", r}}, points, 4 * std::numbers::pi * r * r * r / 3);
}

TEST(ShapeInertia, Cylinder) {
  constexpr double r = 0.2, l = 0.6;
  std::vector<PointMass> points;
  const auto width = [&](double) { return r; };
  fill(points, -l / 2, l / 2, width, width);
  expect_inertia("cylinder", {{"radius", r}, {"length", l}}, points, std::numbers::pi * r * r * l);
}

TEST(ShapeInertia, Capsule) {
  constexpr double r = 0.2, l = 0.5;
  std::vector<PointMass> points;
  const auto straight = [&](double) { return r; };
  const auto round = [&](double z) { return std::sqrt(r * r - (std::abs(z) - l / 2) * (std::abs(z) - l / 2)); };
  fill(points, -l / 2, l / 2, straight, straight);
  fill(points, l / 2, l / 2 + r, round, round);
  fill(points, -l / 2 - r, -l / 2, round, round);
  const double volume = std::numbers::pi * r * r * (l + 4 * r / 3);
  expect_inertia("capsule", {{"radius", r}, {"length", l}}, points, volume);
}

TEST(ShapeInertia, CapsuleWithoutLengthIsASphere) {
  const Vector capsule = find_shape("capsule")->moments(2, {{{"radius", 0.4}, {"length", 0.0}}});
  const Vector sphere = find_shape("sphere")->moments(2, {{{"radius", 0.4}}});
  EXPECT_LE((capsule - sphere).norm(), 1e-15);
}

TEST(ShapeInertia, Ellipsoid) {
  const Vector axes(0.2, 0.3, 0.5);
  std::vector<PointMass> points;
  const auto share = [&](double z) { return std::sqrt(1 - z * z / (axes[2] * axes[2])); };
  fill(
      points, -axes[2], axes[2], [&](double z) { return axes[0] * share(z); },
      [&](double z) { return axes[1] * share(z); });
  expect_inertia("ellipsoid", {{"semi_axes", axes}}, points, 4 * std::numbers::pi * axes.prod() / 3);
}

TEST(ShapeInertia, EveryShapeIsABodyAndHasItsTest) {
  std::vector<std::string> names;
  for (const ShapeEntry& kind : shape_catalogue()) {
    EXPECT_EQ(find_shape(kind.name), &kind);
    EXPECT_FALSE(kind.summary.empty());
    if (!kind.moments) continue;
    names.push_back(kind.name);
    EXPECT_FALSE(kind.moments_formula.empty());
    Sizes sizes;
    for (const Parameter& p : kind.parameters) {
      EXPECT_EQ(p.unit, "m") << kind.name << "." << p.key;
      if (std::holds_alternative<double>(p.value)) {
        sizes[p.key] = 0.7;
      } else {
        sizes[p.key] = Vector(0.5, 0.7, 1.1);
      }
    }
    EXPECT_EQ(inertia_fault(kind.moments(3, {sizes}).asDiagonal()), "") << kind.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"sphere", "box", "capsule", "cylinder", "ellipsoid"}));
  EXPECT_EQ(find_shape("torus"), nullptr);
}

}  // namespace
}  // namespace polhode::shape_inertia_test
