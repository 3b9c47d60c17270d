// SPDX-License-Identifier: BSD-3-Clause
// The vectors and matrices of the mechanics, on any scalar S (float, double, long double, Lanes).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>  // cross

namespace polhode::inline core::inline math {

template <class S>
using Vector3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Matrix3 = Eigen::Matrix<S, 3, 3>;
template <class S>
using VectorX = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// The cross-product matrix ω*: skew(a) b = a × b (course report, section 2.1).
template <class S>
Matrix3<S> skew(const Vector3<S>& a) {
  Matrix3<S> m;
  m << S(0), -a.z(), a.y(), a.z(), S(0), -a.x(), -a.y(), a.x(), S(0);
  return m;
}

}  // namespace polhode::core::math
