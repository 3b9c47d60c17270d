// SPDX-License-Identifier: BSD-3-Clause
// The inertia ellipsoid is what Poinsot's construction says.
#include <gtest/gtest.h>

#include <limits>

#include "core/math/quaternion.hpp"
#include "experiments/viewer/drawing/polhode_pass.hpp"

namespace polhode::viewer::polhode_test {
namespace {

const Matrix3<double> turned =
    rotation_matrix(quaternion_from_rotation_vector<double>(Vector3<double>(0.4, -1.1, 0.7)));
const Matrix3<double> inertia = turned * Vector3<double>(5, 2, 3).asDiagonal() * turned.transpose();
const Vector3<double> omega(0.3, -1.2, 2.1);

TEST(InertiaEllipsoid, OmegaIsOnItAndThePlaneAcrossLTouchesItThere) {
  for (const Matrix3<double>& body :
       {Matrix3<double>(Matrix3<double>::Identity()), Matrix3<double>(turned.transpose())}) {
    const auto e = InertiaEllipsoid::of(inertia, omega, body);
    ASSERT_TRUE(e);
    EXPECT_NEAR(e->semi_axes[0], 1, 1e-14);
    EXPECT_LT((e->omega * e->unit - body * omega).norm(), 1e-14);
    EXPECT_NEAR((e->axes.transpose() * e->omega).cwiseQuotient(e->semi_axes).norm(), 1, 1e-14);
    // The furthest that the ellipsoid reaches along L is as far as ω does.
    const double furthest = (e->axes.transpose() * e->momentum).cwiseProduct(e->semi_axes).norm();
    EXPECT_NEAR(furthest, e->momentum.dot(e->omega), 1e-14);
    EXPECT_NEAR(furthest, omega.dot(inertia * omega) / (inertia * omega).norm() / e->unit, 1e-14);
  }
}

TEST(InertiaEllipsoid, ThereIsNoneOfWhatDoesNotTurnOrHasDiverged) {
  const Matrix3<double> body = Matrix3<double>::Identity();
  EXPECT_FALSE(InertiaEllipsoid::of(inertia, Vector3<double>::Zero(), body));
  EXPECT_FALSE(
      InertiaEllipsoid::of(inertia, Vector3<double>::Constant(std::numeric_limits<double>::quiet_NaN()), body));
  EXPECT_FALSE(InertiaEllipsoid::of(inertia, Vector3<double>::Constant(1e300), body));
}

}  // namespace
}  // namespace polhode::viewer::polhode_test
