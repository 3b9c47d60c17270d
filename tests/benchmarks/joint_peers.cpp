// SPDX-License-Identifier: BSD-3-Clause
// Error against cost of jointed mechanisms: ours beside Simbody, MuJoCo, ODE, Bullet and DART where they are installed.
// Three plane mechanisms start alike in every program, and each program says where one body is at the end:
//   pendulum  a rod of 1.5 m from the horizontal, 10 s: an elliptic function, that of a point on 1 m (IFToMM A01);
//   squares   two four-bar mechanisms, 4 s, through the configuration in which they lie flat: a quadrature (A02);
//   chain     ten rods and a ball a hundred times as heavy, let go 30° from the vertical, 2 s: our own Fehlberg 7(8)
//             at 1e-13, whose agreement with IDA is printed first;
//   hanging   the same chain at rest, straight down, with a ball of 1 to 10000 kg, 5 s at 1/60 s: the error is how far
//             the chain has stretched.
// Writes a table (CSV) to standard output; joint_peers.sh draws it. Wall times are the best of several runs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>

#include "core/joints/catalogue.hpp"
#include "core/run/simulate.hpp"
#include "integrators/catalogue.hpp"
#include "tests/benchmarks/peers/mechanism.hpp"

namespace {

using namespace polhode;
using peers::Arrival;
using peers::Mechanism;
using peers::Program;

struct Known {
  Mechanism mechanism;
  double x = 0, y = 0;  ///< place of the probe at the end, m
};

Known pendulum() {
  Known k{{.name = "pendulum", .t_end = 10}, -0.75 * 0.27508746257611686, -0.75 * 0.961419205099125064};
  k.mechanism.bodies = {{.mass = 1, .inertia = 1.5 * 1.5 / 12, .x = -0.75}};
  k.mechanism.hinges = {{.body = 0}};
  return k;
}

Known squares() {
  Known k{{.name = "squares", .t_end = 4}, 0.5 * 0.117616102376808612, 0.5 * 0.993059138451325101};
  for (int i = 0; i < 5; ++i) {  // link, coupler, link, coupler, link
    const bool link = i % 2 == 0;
    k.mechanism.bodies.push_back({.mass = 1,
                                  .inertia = 1.0 / 12,
                                  .x = 0.5 * i,
                                  .y = link ? 0.5 : 1,
                                  .vx = link ? 0.5 : 1,
                                  .spin = link ? -1.0 : 0});
    const double place = link ? 0.5 * i : 0.5 * (i - 1);
    k.mechanism.hinges.push_back({.body = i, .other = i - 1, .x = place, .y = i == 0 ? 0.0 : 1.0});
    if (link && i > 0) k.mechanism.hinges.push_back({.body = i, .other = -1, .x = place, .y = 0, .closes = true});
  }
  return k;
}

Known chain() {
  Known k{{.name = "chain", .t_end = 2}};
  const double sine = 0.5, cosine = std::sqrt(0.75);
  for (int i = 0; i < 10; ++i) {
    k.mechanism.bodies.push_back({.mass = 1, .inertia = 1.0 / 12, .x = sine * (i + 0.5), .y = -cosine * (i + 0.5)});
    k.mechanism.hinges.push_back({.body = i, .other = i - 1, .x = sine * i, .y = -cosine * i});
  }
  k.mechanism.bodies.push_back({.mass = 100, .inertia = 1, .x = sine * 10, .y = -cosine * 10});
  k.mechanism.hinges.push_back({.body = 10, .other = 9, .x = sine * 10, .y = -cosine * 10});
  k.mechanism.probe = 10;
  return k;
}

Known hanging(double ball) {
  Known k{{.name = "hanging", .t_end = 5}, 0, -10};
  for (int i = 0; i < 11; ++i) {
    const bool rod = i < 10;
    k.mechanism.bodies.push_back({.mass = rod ? 1 : ball, .inertia = rod ? 1.0 / 12 : 0.1, .y = rod ? -i - 0.5 : -10});
    k.mechanism.hinges.push_back({.body = i, .other = i - 1, .y = -double(i)});
  }
  k.mechanism.name += "_" + std::to_string(int(ball)) + "_kg";
  k.mechanism.probe = 10;
  return k;
}

// ---- ours: six coordinates for each body; a planar joint keeps it in the plane, and pins are the hinges

JointParameters joint_of(const std::string& kind, std::vector<std::size_t> ends, const std::string& name) {
  JointParameters joint{name, {kind, std::move(ends), {}}};
  for (const Parameter& key : find_joint(kind)->kind.parameters) joint.of.values[key.key] = key.value;
  for (const char* anchor : {"anchor_body", "anchor_body_2", "anchor_world"})
    joint.of.values[anchor] = Vector3<double>(0, 0, 0);
  joint.of.values["axis_body"] = Vector3<double>(0, 0, 1);
  return joint;
}

Problem problem_of(const Mechanism& m) {
  Problem p;
  ForceParameters weight{"uniform_gravity", {}, {{"acceleration", Vector3<double>(0, -peers::gravity, 0)}}};
  for (std::size_t i = 0; i < m.bodies.size(); ++i) {
    const peers::PlaneBody& b = m.bodies[i];
    p.bodies.push_back({.name = "b" + std::to_string(i),
                        .mass = b.mass,
                        .inertia = Matrix3<double>(b.inertia * Matrix3<double>::Identity())});
    p.starts.push_back({.position = {b.x, b.y, 0}, .velocity = {b.vx, b.vy, 0}, .angular_velocity = {0, 0, b.spin}});
    weight.bodies.push_back(i);
  }
  p.forces.push_back(weight);
  for (std::size_t i = 0; i < m.bodies.size(); ++i)
    p.joints.push_back(joint_of("planar", {i}, "plane" + std::to_string(i)));
  for (const peers::Hinge& h : m.hinges) {
    std::vector<std::size_t> ends = {std::size_t(h.body)};
    if (h.other >= 0) ends.push_back(std::size_t(h.other));
    JointParameters joint = joint_of("pin", ends, "pin" + std::to_string(p.joints.size()));
    const auto arm = [&](std::size_t body) {
      return Vector3<double>(h.x - m.bodies[body].x, h.y - m.bodies[body].y, 0);
    };
    joint.of.values["anchor_body"] = arm(ends[0]);
    if (ends.size() > 1) joint.of.values["anchor_body_2"] = arm(ends[1]);
    else joint.of.values["anchor_world"] = Vector3<double>(h.x, h.y, 0);
    p.joints.push_back(joint);
  }
  return p;
}

Arrival run_ours(const Mechanism& m, const char* method, double size) {
  const IntegratorEntry& entry = *find_integrator(method);
  Formulation formulation;
  if (!entry.declaration.solves_joints()) formulation.joints.stabilization = Stabilization::both;
  const auto system = make_system<double>(problem_of(m), formulation);
  const bool adaptive = entry.declaration.adaptive;
  const auto integrator = entry.make(*system, {.dt = size, .tolerance = size, .t_end = m.t_end});
  State<double> state = system->start();
  Observer nobody;
  Arrival a;
  a.wall = peers::timed([&] {
    const Schedule schedule{.t_end = m.t_end, .dt = size, .adaptive = adaptive, .samples = 1};
    const RunOutcome outcome = simulate(*system, *system, *integrator, state, schedule, nobody);
    if (outcome.status != RunStatus::ok) throw std::runtime_error(outcome.message);
    a.steps = static_cast<long>(outcome.steps);
  });
  const auto place = system->motion_of(state.y, std::size_t(m.probe)).position;
  a.x = place.x();
  a.y = place.y();
  return a;
}

template <const char* method>
Arrival ours(const Mechanism& m, double size) {
  return run_ours(m, method, size);
}

constexpr char rk4[] = "rk4", rattle[] = "rattle", half_explicit[] = "half_explicit4", fehlberg[] = "odeint_fehlberg78",
               ggl[] = "ida_ggl", ode_step[] = "recipe_ode_step", quick_step[] = "recipe_ode_quickstep",
               bullet[] = "recipe_bullet_joints", dart[] = "recipe_dart_joints";

std::vector<Program> all_programs() {
  std::vector<Program> all = {{"polhode", "rk4, projected", false, &ours<rk4>},
                              {"polhode", rattle, false, &ours<rattle>},
                              {"polhode", half_explicit, false, &ours<half_explicit>},
                              {"polhode", "odeint_fehlberg78, projected", true, &ours<fehlberg>},
                              {"polhode", ggl, true, &ours<ggl>},
                              {"polhode", ode_step, false, &ours<ode_step>}};
  [[maybe_unused]] const auto add = [&](const std::vector<Program>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  [[maybe_unused]] const auto skipped = [](const char* name, const char* package) {
    std::fprintf(stderr, "%s: skipped, because %s is not installed\n", name, package);
  };
#ifdef POLHODE_HAS_SIMBODY
  add(peers::simbody_programs());
#else
  skipped("Simbody", "libsimbody-dev");
#endif
#ifdef POLHODE_HAS_MUJOCO
  add(peers::mujoco_programs());
#else
  skipped("MuJoCo", "libmujoco-dev");
#endif
#ifdef POLHODE_HAS_ODE
  add(peers::ode_programs());
#else
  skipped("ODE", "libode-dev");
#endif
#ifdef POLHODE_HAS_BULLET
  add(peers::bullet_programs());
#else
  skipped("Bullet", "libbullet-dev");
#endif
#ifdef POLHODE_HAS_DART
  add(peers::dart_programs());
#else
  skipped("DART", "libdart-dev");
#endif
  return all;
}

void report(const Known& known, const Program& program, double size) {
  constexpr double long_enough = 0.3;  // run time, s, from which a run is not repeated
  constexpr int most_runs = 5;
  try {
    Arrival best = program.run(known.mechanism, size);
    for (int k = 1; k < most_runs && best.wall < long_enough; ++k)
      best.wall = std::min(best.wall, program.run(known.mechanism, size).wall);
    const double error = std::hypot(best.x - known.x, best.y - known.y);
    std::printf("%s,%s,\"%s\",%s,%.6g,%ld,%.6g,%.6g\n", known.mechanism.name.c_str(), program.name.c_str(),
                program.method.c_str(), program.adaptive ? "tolerance" : "step_s", size, best.steps, best.wall, error);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "%s, %s at %g on %s: %s\n", program.name.c_str(), program.method.c_str(), size,
                 known.mechanism.name.c_str(), failure.what());
  }
  std::fflush(stdout);
}

}  // namespace

int main() {
  const std::vector<Program> recipes = {{"polhode", quick_step, false, &ours<quick_step>},
                                        {"polhode", bullet, false, &ours<bullet>},
                                        {"polhode", dart, false, &ours<dart>}};
  std::vector<Known> all = {pendulum(), squares(), chain()};
  Known& last = all.back();
  const Arrival end = run_ours(last.mechanism, fehlberg, 1e-13), again = run_ours(last.mechanism, ggl, 1e-11);
  last.x = end.x;
  last.y = end.y;
  std::fprintf(stderr, "chain: Fehlberg 7(8) and IDA are %.2g m from each other\n",
               std::hypot(end.x - again.x, end.y - again.y));
  std::printf("mechanism,program,method,size_is,size,steps,wall_s,error_m\n");
  const std::vector<Program> programs = all_programs();
  for (const Known& known : all) {
    for (const Program& program : programs) {
      if (program.adaptive) {
        for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10}) report(known, program, tolerance);
      } else {
        for (const double rate : {50.0, 200.0, 800.0, 3200.0}) report(known, program, 1 / rate);
      }
    }
  }
  for (const double ball : {1.0, 10.0, 100.0, 1000.0, 10000.0}) {
    const Known known = hanging(ball);
    for (const Program& program : programs) {
      if (!program.adaptive) report(known, program, 1.0 / 60);
    }
    for (const Program& program : recipes) report(known, program, 1.0 / 60);
  }
}
