// SPDX-License-Identifier: BSD-3-Clause
// The quaternions of the engine slides against ours: the product letter by letter, the rotation that a quaternion
// stands for, and the slides' transform matrix, which is the transpose of that rotation.
#include "core/math/quaternion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/system/orientation_chart.hpp"

namespace polhode::quaternion_test {
namespace {

using Q = Quaternion<double>;
using Matrix = Matrix3<double>;
using Vector = Vector3<double>;

/// "Quaternion Operations".
Q slides_product(const Q& a, const Q& b) {
  const double w1 = a[0], x1 = a[1], y1 = a[2], z1 = a[3], w2 = b[0], x2 = b[1], y2 = b[2], z2 = b[3];
  return {w1 * w2 - x1 * x2 - y1 * y2 - z1 * z2, w1 * x2 + x1 * w2 + y1 * z2 - z1 * y2,
          w1 * y2 - x1 * z2 + y1 * w2 + z1 * x2, w1 * z2 + x1 * y2 - y1 * x2 + z1 * w2};
}

/// "Computing the Transform Matrix", its rotation part.
Matrix slides_matrix(const Q& q) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  Matrix m;
  m << 2 * x * x + 2 * w * w - 1, 2 * x * y + 2 * z * w, 2 * x * z - 2 * y * w,  //
      2 * x * y - 2 * z * w, 2 * y * y + 2 * w * w - 1, 2 * y * z + 2 * x * w,   //
      2 * x * z + 2 * y * w, 2 * y * z - 2 * x * w, 2 * z * z + 2 * w * w - 1;
  return m;
}

std::vector<Q> some_quaternions() {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<Q> all;
  for (int k = 0; k < 100; ++k) all.push_back(Q::NullaryExpr([&] { return normal(random); }).normalized());
  return all;
}

TEST(SlidesQuaternions, UnitsAndProduct) {
  const Q one(1, 0, 0, 0), i(0, 1, 0, 0), j(0, 0, 1, 0), k(0, 0, 0, 1);
  EXPECT_EQ(product<double>(i, j), k);
  EXPECT_EQ(product<double>(j, i), -k);
  EXPECT_EQ(product<double>(j, k), i);
  EXPECT_EQ(product<double>(k, j), -i);
  EXPECT_EQ(product<double>(k, i), j);
  EXPECT_EQ(product<double>(i, k), -j);
  for (const Q& unit : {i, j, k}) EXPECT_EQ(product<double>(unit, unit), -one);
  EXPECT_EQ(product<double>(product<double>(i, j), k), -one);
  const std::vector<Q> q = some_quaternions();
  for (std::size_t n = 1; n < q.size(); ++n) {
    EXPECT_LT((product<double>(q[n - 1], q[n]) - slides_product(q[n - 1], q[n])).norm(), 1e-15);
  }
}

// θ = cos(θ/2) + n sin(θ/2), by the right-hand rule.
TEST(SlidesQuaternions, OrientationTurnsAboutItsAxis) {
  const Q quarter = quaternion_from_rotation_vector<double>({0, 0, std::acos(0.0)});
  EXPECT_LT((quarter - Q(std::sqrt(0.5), 0, 0, std::sqrt(0.5))).norm(), 1e-15);
  EXPECT_LT((rotation_matrix<double>(quarter) * Vector(1, 0, 0) - Vector(0, 1, 0)).norm(), 1e-15);
  EXPECT_LT((slides_matrix(quarter) * Vector(1, 0, 0) - Vector(0, -1, 0)).norm(), 1e-15) << "the other way round";
}

// q v q*, which q̇ = ½ ω q turns by ω × (q v q*), is Mᵀ v.
TEST(SlidesQuaternions, TransformMatrixIsTheTransposeOfTheRotation) {
  const Vector v(0.3, -0.7, 0.5), w(0.4, 1.1, -0.6);
  for (const Q& q : some_quaternions()) {
    const Q rotated = slides_product(slides_product(q, pure<double>(v)), conjugate<double>(q));
    EXPECT_LT((rotated.tail<3>() - slides_matrix(q).transpose() * v).norm(), 1e-15);
    EXPECT_LT((rotation_matrix<double>(q) - slides_matrix(q).transpose()).norm(), 2e-15);
    const Q rate = Chart<double, Orientation::quaternion>::rate_world(q, w);
    EXPECT_LT((rate - 0.5 * slides_product(pure<double>(w), q)).norm(), 1e-15);
    const Q spun = product<double>(product<double>(rate, pure<double>(v)), conjugate<double>(q)) +
                   product<double>(product<double>(q, pure<double>(v)), conjugate<double>(rate));
    EXPECT_LT((spun.tail<3>() - w.cross(rotated.tail<3>())).norm(), 1e-15 * 4);
  }
}

}  // namespace
}  // namespace polhode::quaternion_test
