// SPDX-License-Identifier: BSD-3-Clause
// The measurements of a run that was carried out again.
#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

#include "core/run/contact_model.hpp"
#include "experiments/plot/quantities.hpp"
#include "experiments/plot/thinned.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::plot_program {

/// One quantity of a run.
struct Track {
  std::vector<std::vector<SeriesValue>> series{};  ///< values of each component of a quantity against time, thinned
  std::vector<double> times{};                     ///< times of all other quantities, at most 2048, s
  std::vector<std::vector<double>> rows{};         ///< the components at these times
  bool known = true;                               ///< false: this motion does not have the quantity
};

struct Recording {
  RunConfig config;
  std::vector<Track> tracks{};  ///< one track for each quantity
  std::vector<Impact> impacts{};
  std::vector<Transition> slides_end{};
  std::vector<std::string> bodies{};                       ///< names of all bodies of the problem
  Matrix3<double> inertia = Matrix3<double>::Identity();   ///< inertia of the body, body axes, kg m²
  Vector3<double> omega = Vector3<double>::Zero();         ///< its angular velocity at the start, world axes, rad/s
  Vector3<double> momentum = Vector3<double>::Zero();      ///< its angular momentum at the start, world axes, kg m²/s
  Matrix3<double> rotation = Matrix3<double>::Identity();  ///< its rotation at the start
  RunResult result{};
};

/// Carries out the run and measures the quantities at every sample. `body`: the name of a moving body; empty: the first
/// one. Throws InputError if no moving body has the name.
Recording record(const RunConfig& config, const Scenario& scenario, const std::vector<const PlotQuantity*>& quantities,
                 const std::string& body, const std::atomic<bool>* stop);

}  // namespace polhode::study::plot_program
