// SPDX-License-Identifier: BSD-3-Clause
// The motion of one run as the page plays it, from a run that is just carried out or from the files of a study.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/run/contact_model.hpp"
#include "experiments/scene/scene.hpp"
#include "experiments/study/metrics/drift_meter.hpp"

namespace polhode::study::replay {

struct Placement {
  Vector3<double> position = Vector3<double>::Zero();              ///< m, of the mass centre
  Quaternion<double> orientation = identity_quaternion<double>();  ///< body to world, of any length
  Vector3<double> angular_velocity = Vector3<double>::Zero();      ///< rad/s, world
};

/// Which momentum the forces conserve, and so whose drift is shown.
enum class ShownMomentum { none, linear, angular };

struct Recording {
  std::string id;                                          ///< of the run in its study; may be empty
  std::vector<std::pair<std::string, std::string>> facts;  ///< columns and cells of runs.csv
  std::string status = "ok", message;
  Scene scene;
  ShownMomentum momentum = ShownMomentum::none;
  std::string energy_drift_max;  ///< of the whole run, as runs.csv has it

  std::size_t moving = 0;
  std::vector<double> times;                         ///< s
  std::vector<Placement> placements;                 ///< of each instant `moving` of them
  std::vector<double> energy_drift;                  ///< of each instant: relative, signed
  std::vector<double> momentum_drift;                ///< relative; zeros where none is shown
  std::vector<Impact> impacts;                       ///< sorted by time
  std::int64_t instants_seen = 0, impacts_seen = 0;  ///< before anything was left out
};

/// Method and step: "rk4, dt = 0.01 s".
std::string label_of(const Recording& recording);

/// A drift over its scale; 0 where nothing moves, whose scale is 0.
inline double relative(double drift, double scale) { return scale > 0 ? drift / scale : 0; }

/// Angular before linear; none with contact against what stands still.
ShownMomentum shown_momentum(const System<double>& system, const Scenario& scenario);

/// Keeps n instants (two or more), evenly by number, the first and the last among them.
void keep_instants(Recording& recording, std::size_t n);

/// Keeps the n impacts of the largest impulses.
void keep_impacts(Recording& recording, std::size_t n);

/// s, the longest time between two instants that are kept.
double longest_spacing(const Recording& recording);

/// rad, the most that a body turns between two instants that are kept, by its angular velocity at either.
double largest_turn(const Recording& recording);

}  // namespace polhode::study
