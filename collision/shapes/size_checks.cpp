// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/size_checks.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace polhode {

std::string in_words(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

namespace {

[[noreturn]] void refuse(const char* shape, const char* size, const char* needed, const std::string& value) {
  throw std::invalid_argument("a " + std::string(shape) + " needs a " + needed + ", finite " + size + " in m, not " + value);
}

}  // namespace

double positive_size(const char* shape, const char* size, double value) {
  if (!(value > 0) || !std::isfinite(value)) refuse(shape, size, "positive", in_words(value));
  return value;
}

double non_negative_size(const char* shape, const char* size, double value) {
  if (!(value >= 0) || !std::isfinite(value)) refuse(shape, size, "non-negative", in_words(value));
  return value;
}

Vector3<double> positive_sizes(const char* shape, const char* sizes, const Vector3<double>& values) {
  for (const double value : values) {
    if (value > 0 && std::isfinite(value)) continue;
    refuse(shape, sizes, "positive",
           "(" + in_words(values[0]) + ", " + in_words(values[1]) + ", " + in_words(values[2]) + ")");
  }
  return values;
}

MassProperties representable(const char* shape, const MassProperties& mass) {
  bool normal = std::isnormal(mass.volume) && mass.volume > 0 && mass.centroid.allFinite() && mass.inertia.allFinite();
  for (int i = 0; i < 3; ++i) normal = normal && std::isnormal(mass.inertia(i, i)) && mass.inertia(i, i) > 0;
  if (!normal) {
    throw std::invalid_argument("a " + std::string(shape) +
                                " needs sizes whose volume and inertia double can hold, say 1e-50 to 1e50 m");
  }
  return mass;
}

MassProperties centered_mass(double volume, const Vector3<double>& moments) {
  return {volume, Vector3<double>::Zero(), moments.asDiagonal()};
}

}  // namespace polhode
