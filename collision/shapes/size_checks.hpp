// SPDX-License-Identifier: BSD-3-Clause
// What every shape asks of its sizes when it is built, with the reason where it refuses.
#pragma once

#include <string>

#include "collision/shape.hpp"

namespace polhode::inline collision {

/// The sizes that are taken, m: products of five of them, and more, stay far from what double cannot hold.
inline constexpr double smallest_size = 1e-50, largest_size = 1e50;

/// Throws std::invalid_argument, "a sphere needs a positive, finite radius in m, not -1", unless it is so.
double positive_size(const char* shape, const char* size, double value);
double non_negative_size(const char* shape, const char* size, double value);
Vector3<double> positive_sizes(const char* shape, const char* sizes, const Vector3<double>& values);

/// The mass properties of a body with its mass centre at the origin and its principal axes along the axes.
MassProperties centered_mass(double volume, const Vector3<double>& moments);

/// A number in words, all its digits.
std::string in_words(double value);

}  // namespace polhode
