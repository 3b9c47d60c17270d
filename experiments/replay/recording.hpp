// SPDX-License-Identifier: BSD-3-Clause
// Motion of one run for the page, from a run that was just carried out or from the files of a study.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/run/contact_model.hpp"
#include "experiments/study/metrics/drift_meter.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/scene/scene.hpp"

namespace polhode::study::replay {

/// The part of a BodySnapshot that a page shows: 80 bytes instead of 200, for every body at every instant.
struct Placement {
  Vector3<double> position = Vector3<double>::Zero();              ///< position of the mass centre, world frame, m
  Quaternion<double> orientation = identity_quaternion<double>();  ///< body to world, any length
  Vector3<double> angular_velocity = Vector3<double>::Zero();      ///< world frame, rad/s
};

/// Momentum whose drift is shown: one that the forces conserve.
enum class ShownMomentum { none, linear, angular };

struct Recording {
  std::string id;  ///< id of the run in its study; may be empty
  RunConfig config;
  std::string status = "ok", message;
  Scene scene;
  ShownMomentum momentum = ShownMomentum::none;
  std::string energy_drift_max;  ///< largest drift of the whole run, as in runs.csv

  std::size_t moving = 0;
  std::vector<double> times;               ///< times of the instants, s
  std::vector<Placement> placements;       ///< `moving` placements for each instant
  std::size_t joints = 0;                  ///< number of joints with reactions
  std::vector<Vector3<double>> reactions;  ///< `joints` forces for each instant, on first bodies, world, N
  std::vector<double> energy_drift;        ///< energy drift at each instant, relative, signed
  std::vector<double> momentum_drift;      ///< momentum drift at each instant, relative; 0 if no momentum is shown
  std::vector<Impact> impacts;             ///< sorted by time
  std::int64_t instants_seen = 0, impacts_seen = 0;  ///< numbers before any were removed
};

/// Columns and cells of runs.csv that hold the configuration, without the options of some roles. Includes all options
/// on demand.
std::vector<std::pair<std::string, std::string>> facts_of(const RunConfig& config, Roles without = {});

/// Method and step of the run: "rk4, dt = 0.01 s".
std::string label_of(const Recording& recording);

/// A drift over its scale; 0 if the scale is 0, since nothing moves then.
inline double relative(double drift, double scale) { return scale > 0 ? drift / scale : 0; }

/// The momentum to show: the angular one if it is conserved, else the linear one if it is; none if bodies can touch
/// fixed bodies.
ShownMomentum shown_momentum(const System<double>& system, const Scenario& scenario);

/// Reduces the recording to these instants, whose numbers increase.
void keep_these(Recording& recording, std::span<const std::size_t> instants);

/// Reduces the recording to n instants (n ≥ 2), spread evenly by number, including the first and the last.
void keep_instants(Recording& recording, std::size_t n);

/// Reduces the recording to the n impacts with the largest impulses.
void keep_impacts(Recording& recording, std::size_t n);

/// Longest time between consecutive instants, s.
double longest_spacing(const Recording& recording);

/// Largest rotation of a body between consecutive instants, estimated from its angular velocities at both, rad.
double largest_turn(const Recording& recording);

}  // namespace polhode::study::replay
