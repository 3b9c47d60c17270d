// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/size_checks.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace polhode::inline collision::inline shapes {

std::string in_words(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

namespace {

bool taken(double value) { return value >= smallest_size && value <= largest_size; }

[[noreturn]] void refuse(const char* shape, const char* size, const char* needed, const std::string& value, bool fits) {
  const std::string all = "a " + std::string(shape) + " needs a " + needed + ", finite " + size + " in m, not " + value;
  throw std::invalid_argument(fits ? all : all + "; sizes from 1e-50 to 1e50 m are taken");
}

}  // namespace

double positive_size(const char* shape, const char* size, double value) {
  if (!taken(value)) refuse(shape, size, "positive", in_words(value), !(value > 0) || !std::isfinite(value));
  return value;
}

double non_negative_size(const char* shape, const char* size, double value) {
  if (value != 0 && !taken(value)) {
    refuse(shape, size, "non-negative", in_words(value), !(value > 0) || !std::isfinite(value));
  }
  return value;
}

Vector3<double> positive_sizes(const char* shape, const char* sizes, const Vector3<double>& values) {
  for (const double value : values) {
    if (taken(value)) continue;
    refuse(shape, sizes, "positive",
           "(" + in_words(values[0]) + ", " + in_words(values[1]) + ", " + in_words(values[2]) + ")",
           !(value > 0) || !std::isfinite(value));
  }
  return values;
}

MassProperties centered_mass(double volume, const Vector3<double>& moments) {
  return {volume, Vector3<double>::Zero(), moments.asDiagonal()};
}

}  // namespace polhode::collision::shapes
