// SPDX-License-Identifier: BSD-3-Clause
// A half-space is all points with n·x <= c, whatever the length of n.
#include "collision/shapes/half_space.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace polhode::half_space_test {
namespace {

using Vector = Vector3<double>;

TEST(HalfSpace, ThePlaneIsWhereTheNormalAsGivenSaysSo) {
  for (const double length : {1e-300, 1e-3, 0.5, 1.0, 3.0, 1e300}) {
    for (const Vector& n : {Vector(0, 0, 1), Vector(0, -1, 0), Vector(1, 1, 1), Vector(1, 2, -2)}) {
      const Vector normal = length * (n / n.cwiseAbs().maxCoeff());
      const HalfSpace floor(normal, 0.75 * length);
      const Vector on_plane = floor.support(floor.normal());
      EXPECT_NEAR((normal / length).dot(on_plane), 0.75, 1e-15) << length << " along " << n.transpose();
      EXPECT_NEAR(on_plane.norm(), floor.offset(), 1e-15);
    }
  }
  EXPECT_EQ(HalfSpace({0, 0, 2}, 1).bounds({}).max()[2], 0.5);
}

TEST(HalfSpace, APlaneBeyondEveryNumberIsRefused) {
  EXPECT_THROW(HalfSpace({0, 0, 1e-300}, 1e10), std::invalid_argument);
  EXPECT_EQ(HalfSpace({0, 0, 1e-300}, 0).offset(), 0);
  EXPECT_THROW(HalfSpace({1.7e308, 1.7e308, 1.7e308}), std::invalid_argument);
}

}  // namespace
}  // namespace polhode::half_space_test
