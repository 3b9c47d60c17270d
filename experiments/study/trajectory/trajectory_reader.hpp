// SPDX-License-Identifier: BSD-3-Clause
// Reads the trajectory of any program: CSV in the format of trajectory.csv, world axes and SI units. Columns go by
// their names, in any order; others are passed over. Lines may end in CR LF; empty lines and lines that begin with #
// are skipped. Nothing but numbers that are finite is let through.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/quaternion.hpp"
#include "core/problem/problem.hpp"

namespace polhode::study::inline trajectory {

struct TrajectoryBody {
  Vector3<double> position = Vector3<double>::Zero(), velocity = Vector3<double>::Zero();  ///< of the mass centre
  Quaternion<double> orientation = identity_quaternion<double>();                          ///< where it has no matrix
  Matrix3<double> rotation = Matrix3<double>::Identity();                                  ///< where it has one
  Vector3<double> angular_velocity = Vector3<double>::Zero(), angular_momentum = Vector3<double>::Zero();
};

struct Trajectory {
  bool has_matrix = false, has_position = false, has_velocity = false, has_angular_velocity = false;
  bool has_angular_momentum = false, has_energy = false;
  std::size_t moving = 1;              ///< bodies
  std::vector<double> times;           ///< s, increasing, none negative
  std::vector<TrajectoryBody> bodies;  ///< of each instant `moving` of them, in the problem's order
  std::vector<double> energy;          ///< J, of each instant: the file's own
};

/// The text of a file that is named `origin` in errors. Needs t_s, an orientation (qw … qz, or r11 … r33, which is
/// taken where both stand), and `body` unless one body moves; all rows of an instant stand together. Throws InputError,
/// with line, column and a remedy.
Trajectory parse_trajectory(std::string_view text, const std::string& origin, const Problem& problem);

/// Of the file. Throws InputError also where it cannot be read.
Trajectory read_trajectory(const std::string& path, const Problem& problem);

}  // namespace polhode::study
