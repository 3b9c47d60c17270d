// SPDX-License-Identifier: BSD-3-Clause
// Checks of the sizes of shapes, with the reason if a size is refused.
#pragma once

#include <string>

#include "collision/shape.hpp"

namespace polhode::inline collision::inline shapes {

/// The accepted range of sizes (m). Products of five and more of them stay far from overflow and underflow.
inline constexpr double smallest_size = 1e-50, largest_size = 1e50;

/// Returns the value. Throws std::invalid_argument if it is not positive (non-negative, below) and in the range: "a
/// sphere needs a positive, finite radius in m, not -1".
double positive_size(const char* shape, const char* size, double value);
double non_negative_size(const char* shape, const char* size, double value);
Vector3<double> positive_sizes(const char* shape, const char* sizes, const Vector3<double>& values);

/// Mass properties of a body with its mass centre at the origin and its principal axes along the coordinate axes.
MassProperties centered_mass(double volume, const Vector3<double>& moments);

/// A number as text, with all its digits.
std::string in_words(double value);

}  // namespace polhode::collision::shapes
