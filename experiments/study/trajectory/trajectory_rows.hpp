// SPDX-License-Identifier: BSD-3-Clause
// The columns and rows of a trajectory, common to all formats.
#pragma once

#include <string>
#include <vector>

#include "core/run/contact_model.hpp"
#include "core/run/integrator.hpp"

namespace polhode::study::inline trajectory {

/// t_s, body, p, q, v, ω, L, energy_J, and with the matrix chart r11 … r33: world axes, SI units; p and v are of the
/// mass centre, L about the reference point.
std::vector<std::string> trajectory_columns(const System<double>& system);

/// One row for each moving body, in the order of the columns.
std::vector<double> trajectory_row(const System<double>& system, const State<double>& state, std::size_t body,
                                   double energy);

/// The terms of the energy ledger. A system with joints has their work besides.
std::vector<std::string> energy_columns(const System<double>& system);
/// One row of the energy ledger; energy_start is its value at the start.
std::vector<double> energy_row(const System<double>& system, const Sample& sample, const ContactLosses& contact,
                               double energy_start);

/// t_s, joint, body, force and torque: the reaction on the first body of each joint, world axes, at its anchor. Joints
/// and bodies count from 0 in the order of the scenario.
std::vector<std::string> reaction_columns();
/// One row for each joint. `multipliers`: of the method; empty: the reactions follow from the state.
std::vector<std::vector<double>> reaction_rows(const System<double>& system, const State<double>& state,
                                               const VectorX<double>& multipliers);

/// `kind`: with the column of words, which only a table of text has.
std::vector<std::string> event_columns(bool kind);
/// One row, without the kind. That of a transition has no impulse and no loss of energy.
std::vector<double> event_row(const Impact& impact);
std::vector<double> event_row(const Transition& transition);

}  // namespace polhode::study::trajectory
