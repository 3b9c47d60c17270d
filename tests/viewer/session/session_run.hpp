// SPDX-License-Identifier: BSD-3-Clause
// The common parts of the tests of sessions: configurations by name, and time that passes as a test has it.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "experiments/study/scenario/scenario.hpp"
#include "experiments/viewer/session/session.hpp"

namespace polhode::viewer {

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline study::Scenario scenario_of(const std::string& name) { return study::ScenarioSource::open(name).resolve(); }

inline Configuration with(const std::string& scenario, const std::string& integrator, double dt, double t_end) {
  Configuration c = usual_configuration(scenario_of(scenario));
  choose_integrator(c, integrator, dt);
  c.run.t_end = t_end;
  return c;
}

inline std::unique_ptr<Session> open(const std::string& scenario, const Configuration& configuration,
                                     const std::filesystem::path& folder = {}) {
  SessionSetup setup;
  setup.scenario = scenario;
  setup.configuration = configuration;
  if (!folder.empty()) setup.record = folder / "session.toml";
  return live_session(setup);
}

inline std::shared_ptr<const View> settled(Session& session) {
  session.settle();
  return session.view();
}

/// Frames of 1/60 s, at most so many.
inline std::shared_ptr<const View> play_to_end(Session& session, int frames = 100000) {
  session.play();
  for (int k = 0; k < frames && (k == 0 || session.view()->status.playing); ++k) {
    session.tick(1.0 / 60);
    session.settle();
  }
  return session.view();
}

inline bool same(const Frame& a, const Frame& b) {
  if (a.t != b.t || a.step != b.step || a.bodies.size() != b.bodies.size() || a.kinetic != b.kinetic ||
      a.potential != b.potential || a.energy_drift != b.energy_drift) {
    return false;
  }
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    const BodySnapshot<double>&x = a.bodies[i], &y = b.bodies[i];
    if (x.position != y.position || x.orientation != y.orientation || x.velocity != y.velocity ||
        x.angular_velocity != y.angular_velocity || x.angular_momentum != y.angular_momentum) {
      return false;
    }
  }
  return true;
}

}  // namespace polhode::viewer
