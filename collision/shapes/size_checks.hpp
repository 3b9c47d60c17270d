// SPDX-License-Identifier: BSD-3-Clause
// What every shape asks of its sizes when it is built, with the reason where it refuses.
#pragma once

#include <string>

#include "collision/shape.hpp"

namespace polhode {

/// Throws std::invalid_argument, "a box needs a positive, finite size in m, not -1", unless it is so.
double positive_size(const char* shape, const char* size, double value);
double non_negative_size(const char* shape, const char* size, double value);
Vector3<double> positive_sizes(const char* shape, const char* sizes, const Vector3<double>& values);

/// Throws unless volume and moments are normal numbers: sizes of about 1e-60 to 1e60 m, far beyond any body.
MassProperties representable(const char* shape, const MassProperties& mass);

/// The mass properties of a body with its mass centre at the origin and its principal axes along the axes.
MassProperties centered_mass(double volume, const Vector3<double>& moments);

/// A number in words, all its digits.
std::string in_words(double value);

}  // namespace polhode
