// SPDX-License-Identifier: BSD-3-Clause
// Cubes of 1 m and 1 kg that drop, tilted this way and that, into a box without a lid.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "collision/contact/collider.hpp"
#include "collision/shapes/box.hpp"
#include "collision/shapes/half_space.hpp"
#include "core/problem/problem.hpp"

namespace polhode {

struct Pile {
  static constexpr double friction = 0.5, gravity = 9.81;

  Problem problem;
  std::vector<Collider> colliders;
  double half_width;  ///< half the width of the box, whose middle is the origin of x and y, m

  /// `tilt`: rad, at most, about a direction of its own.
  explicit Pile(int cubes, double tilt = 0.5) {
    const int row = int(std::lround(std::cbrt(cubes)));
    half_width = 0.75 * row + 0.2;
    const auto cube = std::make_shared<Box>(Vector3<double>(0.5, 0.5, 0.5));
    ForceParameters weight;
    weight.kind = "uniform_gravity";
    weight.values["acceleration"] = Vector3<double>(0, 0, -gravity);
    for (int i = 0; i < cubes; ++i) {
      Body body;
      body.name = "cube" + std::to_string(i);
      body.mass = 1;
      body.inertia = Matrix3<double>::Identity() / 6;
      problem.bodies.push_back(body);
      colliders.push_back({cube, 0, friction});
      weight.bodies.push_back(std::size_t(i));
      BodyStart& start = problem.starts.emplace_back();
      const int layer = i / (row * row), k = i % (row * row);
      start.position = {(k % row - (row - 1) / 2.0) * 1.5, (k / row - (row - 1) / 2.0) * 1.5, 0.9 + 1.5 * layer};
      // Angles that the golden ratio spreads evenly.
      const double way = 2 * std::numbers::pi * std::fmod(i * std::numbers::phi, 1), turn = tilt * std::sin(i + 1.0);
      start.orientation = {std::cos(turn / 2), std::sin(turn / 2) * std::cos(way), std::sin(turn / 2) * std::sin(way),
                           0};
    }
    problem.forces = {weight};
    for (const auto& [normal, offset] : walls()) {
      Body wall;
      wall.name = "wall" + std::to_string(problem.bodies.size());
      wall.fixed = true;
      problem.bodies.push_back(wall);
      problem.starts.emplace_back();
      colliders.push_back({std::make_shared<HalfSpace>(normal, offset), 0, friction});
    }
  }

  struct Wall {
    Vector3<double> normal;  ///< normal into the box
    double offset;           ///< m
  };
  std::array<Wall, 5> walls() const {
    return {{{{0, 0, 1}, 0},
             {{1, 0, 0}, -half_width},
             {{-1, 0, 0}, -half_width},
             {{0, 1, 0}, -half_width},
             {{0, -1, 0}, -half_width}}};
  }
};

}  // namespace polhode
