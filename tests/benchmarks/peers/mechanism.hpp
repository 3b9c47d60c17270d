// SPDX-License-Identifier: BSD-3-Clause
// A plane mechanism as all programs understand it: bodies that move in the plane z = 0 under gravity along −y, joined
// by hinges about z. A tree of hinges comes first; hinges that close a loop are marked.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace polhode::peers {

struct PlaneBody {
  double mass = 1, inertia = 1;     ///< mass, kg; inertia about the mass centre, the same about every axis, kg m²
  double x = 0, y = 0;              ///< place of the mass centre at the start, m
  double vx = 0, vy = 0, spin = 0;  ///< velocity at the start, m/s; angular velocity, rad/s
};

/// A hinge at a place of the start, of a body on another that comes before it, or on the ground: −1.
struct Hinge {
  int body = 0, other = -1;
  double x = 0, y = 0;  ///< m
  bool closes = false;  ///< a loop
};

constexpr double gravity = 9.81;  // m/s²

struct Mechanism {
  std::string name;
  double t_end = 1;  ///< s
  std::vector<PlaneBody> bodies{};
  std::vector<Hinge> hinges{};
  int probe = 0;  ///< body whose mass centre at t_end is known
};

/// The place of the mass centre of the probe at t_end, and the cost.
struct Arrival {
  double x = 0, y = 0;  ///< m
  double wall = 0;      ///< wall time of the steps alone, s
  long steps = 0;
};

/// A program, or a method of one. `size` is a step (s) or, if adaptive, a tolerance.
struct Program {
  std::string name, method;
  bool adaptive = false;
  Arrival (*run)(const Mechanism&, double size) = nullptr;
};

std::vector<Program> bullet_programs();
std::vector<Program> dart_programs();
std::vector<Program> mujoco_programs();
std::vector<Program> ode_programs();
std::vector<Program> simbody_programs();

/// Wall time, s.
template <class Work>
double timed(const Work& work) {
  const auto begun = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

inline long steps_of(const Mechanism& m, double h) { return static_cast<long>(m.t_end / h + 0.5); }

}  // namespace polhode::peers
