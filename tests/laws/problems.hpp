// SPDX-License-Identifier: BSD-3-Clause
// The problems on which laws are tried: small, of every kind that the mechanics has, with no symmetry by which a
// wrong term could hide.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/forces/catalogue.hpp"
#include "core/problem/problem.hpp"

namespace polhode::laws {

using Values = std::map<std::string, ParameterValue>;

/// A force of the catalogue with the keys given and the rest at their defaults, as the reader of scenarios makes it.
inline ForceParameters force(const std::string& kind, std::vector<std::size_t> bodies, Values values) {
  for (const Parameter& p : find_force(kind)->kind.parameters) values.emplace(p.key, p.value);
  return {kind, std::move(bodies), std::move(values)};
}

inline Matrix3<double> diagonal(double a, double b, double c) { return Vector3<double>(a, b, c).asDiagonal(); }

/// Principal moments (m) turned out of the body's axes by the rotation of q/|q|: R diag(m) Rᵀ, symmetric to the bit.
inline Matrix3<double> turned_inertia(const Vector3<double>& moments, const Quaternion<double>& q) {
  const Matrix3<double> r = rotation_matrix(q);
  const Matrix3<double> m = r * moments.asDiagonal() * r.transpose();
  return 0.5 * (m + m.transpose());
}

/// One free body without forces: J = (0.6, 0.8, 1.0), y0 = (1.8, 0.4, −0.9) (Hairer & Vilmart 2006), body ω = y/J.
inline Problem free_top() {
  Problem p;
  p.bodies.push_back({.name = "top", .inertia = diagonal(0.6, 0.8, 1.0)});
  p.starts.push_back({.velocity = {0.3, -0.2, 0.1},
                      .angular_velocity = {1.8 / 0.6, 0.4 / 0.8, -0.9 / 1.0},
                      .angular_velocity_in_body = true});
  return p;
}

/// One free body under forces that exert no torque and read no rotation; in air one that does work is among them.
inline Problem projectile(bool in_air) {
  Problem p = free_top();
  p.starts[0].orientation = Quaternion<double>(0.2, 0.9, -0.1, 0.4).normalized();
  p.forces.push_back(force("uniform_gravity", {0}, {{"acceleration", Vector3<double>(0.5, 0, -9.81)}}));
  p.forces.push_back(force("spring", {0}, {{"stiffness", 3.0}, {"anchor_world", Vector3<double>(1, 0.5, -2)}}));
  if (in_air) p.forces.push_back(force("drag", {0}, {{"linear", 0.3}, {"quadratic", 0.1}}));
  return p;
}

/// One pinned body under gravity, its mass centre off every principal axis; mass 2 kg, all moments different.
inline Problem heavy_top() {
  Problem p;
  p.bodies.push_back({.name = "top",
                      .mass = 2,
                      .inertia = turned_inertia({0.5, 0.8, 0.4}, {0.9, 0.1, -0.3, 0.2}),
                      .pinned = true,
                      .center_of_mass = {0.1, -0.05, 0.3}});
  p.starts.push_back({.position = {0.5, -0.25, 1},
                      .orientation = Quaternion<double>(0.8, 0.2, -0.4, 0.1).normalized(),
                      .angular_velocity = {0.4, -1.1, 5}});
  p.forces.push_back(force("uniform_gravity", {0}, {{"acceleration", Vector3<double>(0, 0, -9.81)}}));
  return p;
}

/// Two rods that hang from the world by a ball joint and a hinge, under gravity.
inline Problem jointed_rods() {
  Problem p;
  const Vector3<double> up(0, 0, 0.5), down(0, 0, -0.5), along(0, 1, 0), spin(0.3, 2, -1);
  for (const std::string name : {"upper", "lower"}) {
    p.bodies.push_back({.name = name, .mass = 1.5, .inertia = turned_inertia({0.2, 0.25, 0.08}, {0.9, 0.1, 0, 0.2})});
  }
  const Quaternion<double> turn = Quaternion<double>(0.8, 0.3, -0.4, 0.1).normalized();
  const Matrix3<double> r = rotation_matrix<double>(turn);
  // The velocities of the mass centres are those of a rotation about the ball joint.
  const Vector3<double> one = r * down, two = r * (down + 2 * down);
  p.starts.push_back({.position = one, .orientation = turn, .velocity = spin.cross(one), .angular_velocity = spin});
  p.starts.push_back({.position = two, .orientation = turn, .velocity = spin.cross(two), .angular_velocity = spin});
  p.forces.push_back(force("uniform_gravity", {0, 1}, {{"acceleration", Vector3<double>(0, 0, -9.81)}}));
  const Vector3<double> zero = Vector3<double>::Zero();
  p.joints.push_back({"ball", {"ball", {0}, {{"anchor_body", up}, {"anchor_world", zero}, {"anchor_body_2", zero}}}});
  p.joints.push_back({"hinge",
                      {"hinge",
                       {1, 0},
                       {{"anchor_body", up}, {"anchor_world", zero}, {"anchor_body_2", down}, {"axis_body", along}}}});
  return p;
}

/// Rods of 1 m that hang in a vertical line from the world by ball joints, under gravity. Joint i is open by gaps[i]
/// (m); the rods move along the line with `speeds` (m/s, upward).
inline Problem hanging_rods(const std::vector<double>& masses, const std::vector<double>& gaps,
                            const std::vector<double>& speeds) {
  Problem p;
  const Vector3<double> up(0, 0, 0.5), zero = Vector3<double>::Zero();
  std::vector<std::size_t> all;
  double z = 0;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    z -= gaps[i];
    p.bodies.push_back({.name = "rod_" + std::to_string(i),
                        .mass = masses[i],
                        .inertia = diagonal(masses[i] / 12, masses[i] / 12, masses[i] / 100)});
    p.starts.push_back({.position = {0, 0, z - 0.5}, .velocity = {0, 0, speeds[i]}});
    z -= 1;
    std::vector<std::size_t> ends = {i};
    if (i > 0) ends.push_back(i - 1);
    p.joints.push_back(
        {"joint_" + std::to_string(i),
         {"ball", ends, {{"anchor_body", up}, {"anchor_world", zero}, {"anchor_body_2", Vector3<double>(-up)}}}});
    all.push_back(i);
  }
  p.forces.push_back(force("uniform_gravity", all, {{"acceleration", Vector3<double>(0, 0, -9.81)}}));
  return p;
}

/// One free body on a damped spring fixed at a corner, with gravity and a torque fixed in the body.
inline Problem box_on_spring(const Matrix3<double>& inertia = diagonal(0.5, 0.8, 1.1)) {
  Problem p;
  p.bodies.push_back({.name = "box", .mass = 2, .inertia = inertia});
  p.starts.push_back({.position = {0.2, -0.1, 0.4},
                      .orientation = Quaternion<double>(0.7, -0.3, 0.5, 0.2).normalized(),
                      .velocity = {0.5, -1, 0.25},
                      .angular_velocity = {1, 2, -1.5}});
  p.forces.push_back(force("uniform_gravity", {0}, {{"acceleration", Vector3<double>(0, 0, -9.81)}}));
  p.forces.push_back(force("spring", {0},
                           {{"stiffness", 8.0},
                            {"damping", 0.4},
                            {"rest_length", 0.5},
                            {"anchor_body", Vector3<double>(0.1, 0.25, -0.4)},
                            {"anchor_world", Vector3<double>(0.5, 0, 2)}}));
  p.forces.push_back(
      force("constant_torque", {0}, {{"torque", Vector3<double>(0.3, -0.2, 0.5)}, {"frame", std::string("body")}}));
  return p;
}

/// Two spinning bodies that fall round each other under Newton's gravity.
inline Problem two_bodies() {
  Problem p;
  p.bodies.push_back({.name = "a", .mass = 3, .inertia = diagonal(0.6, 0.8, 1.0)});
  p.bodies.push_back({.name = "b", .mass = 1, .inertia = turned_inertia({0.3, 0.25, 0.45}, {0.6, 0.4, -0.2, 0.3})});
  p.starts.push_back({.position = {-0.25, 0, 0.1}, .velocity = {0, -0.3, 0}, .angular_velocity = {0.5, 1, -2}});
  p.starts.push_back({.position = {1, 0.2, 0},
                      .orientation = Quaternion<double>(0.2, 0.9, -0.1, 0.4).normalized(),
                      .velocity = {0.1, 1.1, 0.3},
                      .angular_velocity = {-1, 0.2, 1.5}});
  p.forces.push_back(force("point_gravity", {0, 1}, {{"gravitational_constant", 0.5}}));
  return p;
}

/// Two free bodies, two pinned ones and a static one under every kind of force.
inline Problem five_bodies() {
  Problem p;
  p.bodies.push_back({.name = "free 1", .mass = 3, .inertia = diagonal(0.6, 0.8, 1.0)});
  p.bodies.push_back({.name = "pinned 1",
                      .mass = 2,
                      .inertia = turned_inertia({0.5, 0.8, 0.4}, {0.9, 0.1, -0.3, 0.2}),
                      .pinned = true,
                      .center_of_mass = {0.1, -0.05, 0.3}});
  p.bodies.push_back(
      {.name = "free 2", .mass = 1.5, .inertia = turned_inertia({0.3, 0.25, 0.45}, {0.6, 0.4, -0.2, 0.3})});
  p.bodies.push_back({.name = "pinned 2",
                      .mass = 0.75,
                      .inertia = diagonal(0.9, 0.7, 0.5),
                      .pinned = true,
                      .center_of_mass = {-0.2, 0.1, 0}});
  p.bodies.push_back({.name = "static", .fixed = true});
  p.starts.push_back({.position = {-0.5, 0.3, 0.1}, .velocity = {0, -0.3, 0.2}, .angular_velocity = {0.5, 1, -2}});
  p.starts.push_back({.position = {0.5, -2, 1},
                      .orientation = Quaternion<double>(0.8, 0.2, -0.4, 0.1).normalized(),
                      .angular_velocity = {0.4, -1.1, 2}});
  p.starts.push_back({.position = {1, 0.2, 0.7},
                      .orientation = Quaternion<double>(0.2, 0.9, -0.1, 0.4).normalized(),
                      .velocity = {0.1, 1.1, 0.3},
                      .angular_velocity = {-1, 0.2, 1.5}});
  p.starts.push_back({.position = {-1, 1.5, 2},
                      .orientation = Quaternion<double>(-0.3, 0.5, 0.6, 0.2).normalized(),
                      .angular_velocity = {1.2, 0.7, -0.4}});
  p.starts.push_back({.position = {2, 2, -1}, .orientation = Quaternion<double>(0.5, -0.5, 0.1, 0.7).normalized()});
  const std::string body = "body";
  p.forces.push_back(force("uniform_gravity", {0, 1, 2, 3}, {{"acceleration", Vector3<double>(0.5, 0, -9.81)}}));
  p.forces.push_back(force("point_gravity", {0, 2}, {{"gravitational_constant", 0.5}}));
  p.forces.push_back(force("point_gravity", {1, 2}, {{"gravitational_constant", 0.25}}));
  p.forces.push_back(force("spring", {0, 2},
                           {{"stiffness", 5.0},
                            {"damping", 0.3},
                            {"rest_length", 0.75},
                            {"anchor_body", Vector3<double>(0.1, 0.2, -0.1)},
                            {"anchor_body_2", Vector3<double>(-0.2, 0.1, 0.3)}}));
  p.forces.push_back(force("spring", {1, 3},
                           {{"stiffness", 2.0},
                            {"anchor_body", Vector3<double>(0.4, 0.2, -0.3)},
                            {"anchor_body_2", Vector3<double>(0.3, 0.5, 0.1)}}));
  p.forces.push_back(force("damper", {2, 4},
                           {{"damping", 0.4},
                            {"anchor_body", Vector3<double>(0.1, -0.3, 0.2)},
                            {"anchor_body_2", Vector3<double>(0.5, 0, 0.25)}}));
  p.forces.push_back(force("drag", {0, 1, 2}, {{"linear", 0.1}, {"quadratic", 0.05}, {"angular", 0.02}}));
  p.forces.push_back(force(
      "constant_force", {2, 3},
      {{"force", Vector3<double>(0.4, -0.3, 0.6)}, {"frame", body}, {"anchor_body", Vector3<double>(0.2, 0.1, -0.3)}}));
  p.forces.push_back(force("constant_torque", {0, 3}, {{"torque", Vector3<double>(0.2, 0.1, -0.3)}}));
  return p;
}

struct NamedProblem {
  std::string name;
  Problem problem;
};

inline std::vector<NamedProblem> all_problems() {
  return {{"free_top", free_top()},
          {"projectile", projectile(false)},
          {"projectile_in_air", projectile(true)},
          {"heavy_top", heavy_top()},
          {"box_on_spring", box_on_spring()},
          {"turned_box_on_spring", box_on_spring(turned_inertia({0.5, 0.8, 1.1}, {0.7, -0.4, 0.2, 0.5}))},
          {"two_bodies", two_bodies()},
          {"five_bodies", five_bodies()}};
}

}  // namespace polhode::laws
