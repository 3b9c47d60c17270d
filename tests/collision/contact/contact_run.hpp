// SPDX-License-Identifier: BSD-3-Clause
// Bodies above a floor, run with contact by any method, response and timing, and the results that tests read.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "collision/contact/event_located.hpp"
#include "collision/contact/time_stepping.hpp"
#include "collision/shapes/half_space.hpp"
#include "core/problem/inertia.hpp"
#include "core/run/simulate.hpp"
#include "integrators/catalogue.hpp"

namespace polhode {

enum class Timing { at_step, at_step_reflecting_free_end, located };

struct ContactRun {
  // The scene.
  Problem problem;
  std::vector<Collider> colliders;
  std::string method = "rk4", response = "sequential_impulses", broad_phase = "sweep_and_prune", narrow_phase = "sat";
  Timing timing = Timing::located;  // timing of responses by impulses
  Compliance compliance{};          // compliance of responses by forces
  double dt = 1e-3, tolerance = 1e-10, t_end = 1;
  Formulation formulation{};

  // The results.
  RunOutcome outcome;
  std::vector<Sample> samples;             // samples after every step
  std::vector<BodySnapshot<double>> path;  // snapshots of the body 0, at the same times
  std::vector<Impact> impacts;
  std::vector<Transition> transitions;
  ContactLosses losses;
  State<double> end;

  /// A body of uniform density.
  void add(double mass, ShapePointer shape, const BodyStart& start, double restitution = 0, double friction = 0) {
    Body body;
    body.name = "body" + std::to_string(problem.bodies.size());
    body.mass = mass;
    const MassProperties m = shape->mass_properties();
    body.inertia = mass / m.volume * m.inertia;
    problem.bodies.push_back(body);
    problem.starts.push_back(start);
    colliders.push_back({std::move(shape), restitution, friction});
  }
  /// The last of the bodies.
  void add_floor(double restitution = 0, double friction = 0, const Vector3<double>& normal = {0, 0, 1}) {
    Body floor;
    floor.name = "floor";
    floor.fixed = true;
    problem.bodies.push_back(floor);
    problem.starts.emplace_back();
    colliders.push_back({std::make_shared<HalfSpace>(normal), restitution, friction});
  }
  void add_gravity(double g = 9.81) {
    ForceParameters gravity;
    gravity.kind = "uniform_gravity";
    for (std::size_t i = 0; i < problem.moving(); ++i) gravity.bodies.push_back(i);
    gravity.values["acceleration"] = Vector3<double>(0, 0, -g);
    problem.forces.push_back(gravity);
  }

  void run() {
    const auto system = make_system<double>(problem, formulation);
    ContactScene scene(problem, colliders, broad_phase, narrow_phase);
    const ResponseEntry& answer = *find_response(response);
    std::unique_ptr<ContactModel> contact;
    if (!answer.make) {
      system->add_force(answer.make_force(*system, scene, compliance));
    } else if (timing == Timing::located) {
      contact = std::make_unique<EventLocated>(*system, scene, answer.make());
    } else {
      contact = std::make_unique<TimeStepping>(
          *system, scene, answer.make(), timing == Timing::at_step ? Reflected::at_start : Reflected::at_free_end);
    }
    const IntegratorEntry& entry = *find_integrator(method);
    const auto integrator = entry.make(*system, {.dt = dt, .tolerance = tolerance, .t_end = t_end});
    const Schedule schedule{.t_end = t_end, .dt = dt, .adaptive = entry.declaration.adaptive, .samples = {}};
    end = system->start();
    Recorder recorder(*this, *system);
    outcome = simulate(*system, *system, *integrator, end, schedule, recorder, nullptr, contact.get());
    EXPECT_EQ(outcome.status, RunStatus::ok) << outcome.message;
  }

 private:
  struct Recorder final : Observer {
    Recorder(ContactRun& to, const System<double>& s) : run(to), system(s) {}
    std::size_t on_samples(std::span<const Sample> seen) override {
      run.samples.insert(run.samples.end(), seen.begin(), seen.end());
      return seen.size();
    }
    void on_impacts(std::span<const Impact> some) override {
      run.impacts.insert(run.impacts.end(), some.begin(), some.end());
    }
    void on_slides_end(std::span<const Transition> some) override {
      run.transitions.insert(run.transitions.end(), some.begin(), some.end());
    }
    void on_contact_energy(const ContactLosses& all) override { run.losses = all; }
    void on_state(const State<double>& state, const Sample&) override {
      run.path.push_back(system.snapshot(state.y, 0));
    }
    double next_state() const override { return 0; }
    ContactRun& run;
    const System<double>& system;
  };
};

}  // namespace polhode
