// SPDX-License-Identifier: BSD-3-Clause
// Reads trajectories written by any program: CSV in the format of trajectory.csv, world axes and SI units. Columns may
// be in any order; unknown columns are skipped. Lines may end in CR LF. Empty lines and lines that begin with # are
// skipped. All numbers must be finite.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/problem/body_snapshot.hpp"
#include "core/problem/problem.hpp"

namespace polhode::study::inline trajectory {

struct Trajectory {
  /// The columns of the file. What it lacks is zero in `bodies`. Of orientation and rotation each gives the other.
  bool has_matrix = false, has_position = false, has_velocity = false, has_angular_velocity = false;
  bool has_angular_momentum = false, has_energy = false;
  std::size_t moving = 1;                    ///< number of moving bodies
  std::vector<double> times;                 ///< times, increasing, not negative, s
  std::vector<BodySnapshot<double>> bodies;  ///< `moving` bodies for each instant, in the problem's order
  std::vector<double> energy;                ///< energy at each instant, as given in the file, J
};

/// Parses a text; `origin` is its name in errors. Required columns: t_s; an orientation (qw … qz, or r11 … r33, which
/// takes precedence); `body`, unless one body moves. All rows of an instant must be adjacent. Throws InputError with
/// line, column and a remedy.
Trajectory parse_trajectory(std::string_view text, const std::string& origin, const Problem& problem);

/// Reads a file. Throws InputError, also if it cannot be read. Of one in HDF5, which is not read, the error says
/// whether it is whole, and how far it goes.
Trajectory read_trajectory(const std::string& path, const Problem& problem);

}  // namespace polhode::study::trajectory
