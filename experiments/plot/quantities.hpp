// SPDX-License-Identifier: BSD-3-Clause
// The quantities that `plot` can draw of a run: their table, and how each is measured while the run goes.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/run/contact_model.hpp"
#include "core/run/integrator.hpp"
#include "core/system/system.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study::plot_program {

/// A state of the run, and what is known of it.
struct Instant {
  const State<double>& state;
  const Sample& sample;
  const ContactLosses& contact;
  double ledger_start;  ///< Sample::ledger() at the start, J
};

using Measure = std::function<std::vector<double>(const Instant&)>;

/// The form in which the components of a quantity are drawn.
enum class Drawn {
  against_time,  ///< a panel for each component
  portrait,      ///< a panel for each pair of components
  polhode,       ///< a curve on the ellipsoid ω·Iω = 2T(0), in principal axes
  herpolhode,    ///< a curve in the world, with the plane of all ω of the same energy
  stacked,       ///< one above another, with impacts
  events,        ///< impacts against time; nothing is measured
};

struct Component {
  std::string label;   ///< label of the axis, with unit
  std::string column;  ///< name in the data file
};

struct PlotQuantity {
  std::string name, shows;
  Drawn drawn = Drawn::against_time;
  Scale scale = Scale::linear;
  std::vector<Component> components{};
  bool of_a_body = false;  ///< the quantity belongs to the body that --body names
  /// Measures the components; empty: this motion does not have the quantity. `body`: index among the moving ones.
  std::function<Measure(const System<double>& system, std::size_t body)> measure{};
};

std::span<const PlotQuantity> plot_quantities();
/// Throws InputError, which suggests names.
const PlotQuantity& quantity_named(const std::string& name);

}  // namespace polhode::study::plot_program
